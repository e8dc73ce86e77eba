// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "em/core/cloud_scale.hpp"
#include "geometry/kd_tree.hpp"
#include "plane_list.hpp"

namespace hallway::peers {

/// A cloud, and what somebody who knows it tells a peer about it. Lengths in the cloud's unit.
struct Task {
  const std::vector<Vec3>& points;
  double spacing = 0.0;  ///< side of the square of a surface that holds one point; positive
  double noise = 0.0;    ///< standard deviation of the points across their planes; positive
  int min_points = 0;    ///< a plane has at least so many
};

inline constexpr std::uint32_t kInputs[] = {HW_SAMPLE_POINTS};
inline constexpr std::uint32_t kOutputs[] = {HW_OUTPUT_PLANES};

/// What a peer says of itself.
constexpr hw_plugin_info_t peer_info(const char* id, const char* name, const char* help) {
  return sdk::plugin_info(id, name, "0.1.0", "Hallway", help, kInputs, kOutputs);
}

/// Makes a plugin of a library's way to find planes. A `Peer` has
///
///     static constexpr hw_plugin_info_t kInfo;
///     void declare(sdk::Parameters&);                         // options of its own
///     std::vector<Members> find(const Task& task) const;      // the same for the same task
///
/// Noise and spacing are measured as `em1` and `em2` measure them unless they are given, so that every peer is tuned to each cloud.
template <typename Peer>
class PeerPlugin final : public sdk::Plugin {
 public:
  static const hw_plugin_info_t* info() { return &Peer::kInfo; }

  explicit PeerPlugin(const hw_host_t* host) : Plugin(host) {
    parameters().add("noise_m", &noise_, 0.0, 1e9, "m",
                     "Standard deviation of points across planes; 0: measured.");
    parameters().add("spacing_m", &spacing_, 0.0, 1e9, "m",
                     "Root of the surface that a point stands for; 0: measured.");
    parameters().add("min_points", &min_points_, 3, 1'000'000, "points", "A plane with fewer is none.");
    peer_.declare(parameters());
  }

  void activate(const hw_activation_t& activation) override {
    for (std::uint32_t i = 0; i < activation.n_sensors; ++i) {
      if (activation.sensors[i]->kind == HW_SAMPLE_POINTS) return;
    }
    throw sdk::Failure(HW_ERROR_ARGUMENT, "no sensor gives points");
  }

  void reset() override {}

  void report(bool) override {}

  void process(const hw_frame_t& frame) override {
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      if (sample.kind != HW_SAMPLE_POINTS) continue;
      gather_points(*static_cast<const hw_points_t*>(sample.payload));
      PlaneList planes;
      for (Members& members : find()) planes.add(points_, std::move(members));
      planes.put(host(), k);
    }
  }

 private:
  void gather_points(const hw_points_t& given) {
    points_.clear();
    points_.reserve(given.count);
    for (std::uint64_t i = 0; i < given.count; ++i) {
      const hw_point3_t& p = *hw_point_at(&given, i);
      points_.emplace_back(p.x, p.y, p.z);
    }
  }

  std::vector<Members> find() const {
    constexpr double kLeastNoise = 0.05;  // in spacings: a threshold of 0 would miss what rounding moved
    if (points_.size() < static_cast<std::size_t>(min_points_)) return {};
    em::CloudScale scale{spacing_, noise_};
    if (!(spacing_ > 0.0 && noise_ > 0.0)) {
      const em::CloudScale measured = em::measure_scale(points_, KdTree(points_));
      if (!(spacing_ > 0.0)) scale.spacing = measured.spacing;
      if (!(noise_ > 0.0)) scale.noise = std::max(measured.noise, kLeastNoise * scale.spacing);
    }
    if (!(scale.spacing > 0.0 && scale.noise > 0.0)) return {};
    return peer_.find({points_, scale.spacing, scale.noise, min_points_});
  }

  Peer peer_;
  double noise_ = 0.0;
  double spacing_ = 0.0;
  int min_points_ = 100;
  std::vector<Vec3> points_;  ///< of one sample
};

}  // namespace hallway::peers
