// SPDX-License-Identifier: MIT
#include <hallway/plugin.hpp>

#include <optional>
#include <vector>

#include "adapter/option_rows.hpp"
#include "adapter/point_adapter.hpp"
#include "icp/core/localiser.hpp"

namespace hallway::icp {
namespace {

constexpr const char* kAgainst[] = {"previous", "keyframe", "map"};
constexpr const char* kMetrics[] = {"point_to_point", "point_to_plane"};
constexpr const char* kKernels[] = {"none", "huber", "cauchy", "tukey"};

static_assert(kNoLandmark == HW_NO_LANDMARK);

/// The localiser behind the plugin ABI.
class Icp final : public sdk::Plugin {
 public:
  static const hw_plugin_info_t* info();

  explicit Icp(const hw_host_t* host) : Plugin(host) {
    parameters().add_choice("against", &against_, kAgainst, "What each frame is registered with.");
    parameters().add_choice(
        "metric", &metric_, kMetrics,
        "What is made small: the distance of matching points, or that of a point from the plane "
        "through its match.");
    parameters().add_choice("weights", &kernel_, kKernels, "How matches that do not fit are weighted.");
    add_options(parameters(), options_, icp::parameters());
  }

  void activate(const hw_activation_t& activation) override {
    adapter_.activate(activation);
    options_.against = static_cast<Against>(against_);
    options_.metric = static_cast<Metric>(metric_);
    options_.kernel = static_cast<Kernel>(kernel_);
    localiser_.emplace(options_);
  }

  void deactivate() override { localiser_.reset(); }

  void reset() override {
    localiser_->reset();
    adapter_.reset();
  }

  void process(const hw_frame_t& frame) override {
    const Answer& answer = localiser_->process(adapter_.gather(frame));
    adapter_.put_pose(host(), frame, answer.has_pose, answer.T_map_sensor);
    if (options_.against == Against::map) adapter_.put_associations(host(), answer.associations);
    put_counters(answer.counters);
    host().put_map_epoch(answer.epoch);
  }

  void report(bool) override {
    std::vector<hw_landmark_t> landmarks;
    for (const Landmark& landmark : localiser_->landmarks()) {
      const Vec3 p = adapter_.map_point(landmark.position);
      const bool mapped = landmark.observations >= static_cast<std::uint32_t>(options_.min_observations);
      landmarks.push_back({landmarks.size(),
                           {p.x(), p.y(), p.z()},
                           landmark.observations,
                           mapped ? HW_LANDMARK_MAPPED : HW_LANDMARK_TEMPORARY});
    }
    host().put_landmarks(landmarks);
  }

 private:
  void put_counters(const Counters& counters) const {
    const hw_counter_t list[] = {{"lost", static_cast<double>(counters.lost)},
                                 {"searches", static_cast<double>(counters.searches)},
                                 {"keyframes", static_cast<double>(counters.keyframes)},
                                 {"landmarks", static_cast<double>(counters.landmarks)},
                                 {"iterations", static_cast<double>(counters.iterations)},
                                 {"residual_m", counters.residual_m},
                                 {"overlap", counters.overlap}};
    host().put_counters(list);
  }

  Options options_;
  int against_ = static_cast<int>(Options().against);
  int metric_ = static_cast<int>(Options().metric);
  int kernel_ = static_cast<int>(Options().kernel);
  PointAdapter adapter_;
  std::optional<Localiser> localiser_;
};

const hw_plugin_info_t* Icp::info() {
  static constexpr std::uint32_t kInputs[] = {HW_SAMPLE_POINTS};
  static constexpr std::uint32_t kOutputs[] = {HW_OUTPUT_POSE, HW_OUTPUT_LANDMARKS, HW_OUTPUT_ASSOCIATIONS,
                                               HW_OUTPUT_COUNTERS};
  static constexpr hw_plugin_info_t kInfo = sdk::plugin_info(
      "icp", "Iterative closest point", "0.1.0", "Hallway",
      "Localises by registering each frame of points with an earlier one, a keyframe or a map.", kInputs,
      kOutputs);
  return &kInfo;
}

}  // namespace
}  // namespace hallway::icp

HALLWAY_PLUGINS(hallway::icp::Icp);
