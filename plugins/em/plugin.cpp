// SPDX-License-Identifier: MIT
#include <hallway/plugin.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "adapter/option_rows.hpp"
#include "em/core/auto_planes.hpp"
#include "em/core/em1.hpp"
#include "em/core/em2.hpp"

namespace hallway::em {
namespace {

constexpr std::uint32_t kInputs[] = {HW_SAMPLE_POINTS};
constexpr std::uint32_t kOutputs[] = {HW_OUTPUT_PLANES, HW_OUTPUT_COUNTERS};

constexpr hw_plugin_info_t make_info(const char* id, const char* name, const char* help) {
  return sdk::plugin_info(id, name, "0.1.0", "Hallway", help, kInputs, kOutputs);
}

/// The algorithms that this file offers as plugins: their options, and one that runs.
class Auto {
 public:
  using Options = AutoOptions;
  static constexpr hw_plugin_info_t kInfo =
      make_info("em", "Planes by expectation maximisation",
                "Finds finite planes in points; noise and scale are estimated.");
  static auto rows() { return auto_options(); }

  explicit Auto(const Options& options) : extractor_(options), warm_start_(options.warm_start != 0) {}
  /// The planes of a cloud that a sensor gave.
  Extraction extract(std::span<const Vec3> cloud, std::uint32_t sensor) {
    return warm_start_ ? extractor_.extract(cloud, memories_[sensor]) : extractor_.extract(cloud);
  }
  void forget() { memories_.clear(); }

 private:
  PlaneExtractor extractor_;
  bool warm_start_;
  std::map<std::uint32_t, PlaneMemory> memories_;  ///< by sensor
};

/// An algorithm that keeps nothing from frame to frame.
template <typename OptionsOf, Extraction (*kExtract)(std::span<const Vec3>, const OptionsOf&)>
class Forgetful {
 public:
  using Options = OptionsOf;
  explicit Forgetful(const Options& options) : options_(options) {}
  Extraction extract(std::span<const Vec3> cloud, std::uint32_t) const { return kExtract(cloud, options_); }
  void forget() {}

 private:
  Options options_;
};

struct First : Forgetful<Em1Options, &extract_em1> {
  using Forgetful::Forgetful;
  static constexpr hw_plugin_info_t kInfo =
      make_info("em1", "Planes by EM, algorithm 1",
                "Finds finite planes, all of them fitted anew in every iteration (thesis 3.5.2).");
  static auto rows() { return em1_options(); }
};

struct Second : Forgetful<Em2Options, &extract_em2> {
  using Forgetful::Forgetful;
  static constexpr hw_plugin_info_t kInfo = make_info(
      "em2", "Planes by EM, algorithm 2", "Finds finite planes, one grown after the other (thesis 3.5.3).");
  static auto rows() { return em2_options(); }
};

hw_point3_t to_c(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

void copy(const Vec3& from, double (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

/// Answers the planes of every sample of points, in the frame of its sensor. Only a warm start keeps anything from frame to frame.
template <typename Algorithm>
class PlanePlugin final : public sdk::Plugin {
 public:
  static const hw_plugin_info_t* info() { return &Algorithm::kInfo; }

  explicit PlanePlugin(const hw_host_t* host) : Plugin(host) {
    add_options(parameters(), options_, Algorithm::rows());
  }

  void activate(const hw_activation_t& activation) override {
    for (std::uint32_t i = 0; i < activation.n_sensors; ++i) {
      if (activation.sensors[i]->kind == HW_SAMPLE_POINTS) {
        algorithm_.emplace(options_);
        return;
      }
    }
    throw sdk::Failure(HW_ERROR_ARGUMENT, "no sensor gives points");
  }

  void deactivate() override { algorithm_.reset(); }

  void reset() override { algorithm_->forget(); }

  void report(bool) override {}

  void process(const hw_frame_t& frame) override {
    std::uint64_t planes = 0;
    std::uint64_t unlabelled = 0;
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      if (sample.kind != HW_SAMPLE_POINTS) continue;
      const std::span<const Vec3> points = points_of(*static_cast<const hw_points_t*>(sample.payload));
      const Extraction found = algorithm_->extract(points, sample.sensor_id);
      put(k, found);
      planes += found.planes.size();
      for (const std::uint32_t label : found.labels) unlabelled += label == kNoPlane ? 1u : 0u;
    }
    const hw_counter_t list[] = {{"planes", static_cast<double>(planes)},
                                 {"points_without_plane", static_cast<double>(unlabelled)}};
    host().put_counters(list);
  }

 private:
  /// The points of a reading: where it has them, if nothing lies between them, else copied.
  std::span<const Vec3> points_of(const hw_points_t& given) {
    static_assert(sizeof(Vec3) == sizeof(hw_point3_t) && alignof(Vec3) == alignof(hw_point3_t));
    if (given.stride == sizeof(Vec3)) return {static_cast<const Vec3*>(given.points), given.count};
    points_.resize(given.count);
    for (std::uint64_t i = 0; i < given.count; ++i) {
      const hw_point3_t& p = *hw_point_at(&given, i);
      points_[i] = Vec3(p.x, p.y, p.z);
    }
    return points_;
  }

  void put(std::uint32_t sample, const Extraction& found) {
    planes_.clear();
    hull_.clear();
    members_.clear();
    for (const Plane& plane : found.planes) planes_.push_back(take(plane));
    host().put_planes(sample, planes_, hull_, members_);
  }

  /// The plane in the ABI's form; its hull and members go to the lists.
  hw_plane_t take(const Plane& plane) {
    hw_plane_t out{};
    out.id = plane.id;
    copy(plane.normal, out.normal);
    out.offset_m = plane.offset;
    copy(plane.centroid, out.centroid);
    for (std::size_t c = 0; c < plane.corners.size(); ++c) copy(plane.corners[c], out.corners[c]);
    out.n_points = plane.members.size();
    out.rms_m = plane.rms;
    out.exclusive_share = plane.exclusive_share;
    out.first_hull = hull_.size();
    out.n_hull = plane.hull.size();
    for (const Vec3& p : plane.hull) hull_.push_back(to_c(p));
    out.first_member = members_.size();
    out.n_members = plane.members.size();
    members_.insert(members_.end(), plane.members.begin(), plane.members.end());
    return out;
  }

  typename Algorithm::Options options_;
  std::optional<Algorithm> algorithm_;
  std::vector<Vec3> points_;  ///< of one sample, where they had to be copied
  std::vector<hw_plane_t> planes_;
  std::vector<hw_point3_t> hull_;
  std::vector<std::uint32_t> members_;
};

}  // namespace
}  // namespace hallway::em

HALLWAY_PLUGINS(hallway::em::PlanePlugin<hallway::em::Auto>, hallway::em::PlanePlugin<hallway::em::First>,
                hallway::em::PlanePlugin<hallway::em::Second>);
