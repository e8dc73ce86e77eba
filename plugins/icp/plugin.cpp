// SPDX-License-Identifier: MIT
#include <hallway/plugin.hpp>

#include <optional>
#include <vector>

#include "adapter/option_rows.hpp"
#include "adapter/point_adapter.hpp"
#include "icp/core/localiser.hpp"
#include "icp/scan_adapter.hpp"

namespace hallway::icp {
namespace {

constexpr const char* kAgainst[] = {"previous", "keyframe", "map"};
constexpr const char* kMetrics[] = {"point_to_point", "point_to_plane"};
constexpr const char* kInputsUsed[] = {"auto", "points", "scans"};
constexpr const char* kDeskews[] = {"auto", "odometry", "imu", "motion", "none"};
constexpr const char* kKernels[] = {"none", "huber", "cauchy", "tukey"};

static_assert(kNoLandmark == HW_NO_LANDMARK);

/// The localiser and the lidar odometry behind the plugin ABI.
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
    parameters().add_choice(
        "use", &use_, kInputsUsed,
        "Which sensors localise: those of points or a scanner; auto: the scanner where there is one.");
    parameters().add_choice("deskew", &deskew_, kDeskews,
                            "Scans: the source of the motion during a scan; auto: the first of odometry, imu "
                            "(gyroscopes and the last velocity) "
                            "and motion (the last motion) that the robot has; none: rays are taken as "
                            "measured at the scan's end.");
    add_options(parameters(), scan_options_, icp::scan_parameters());
  }

  void activate(const hw_activation_t& activation) override {
    const bool has_scanner = scans_.activate(activation);
    if (use_ == kUseScans && !has_scanner) throw sdk::Failure(HW_ERROR_ARGUMENT, "no sensor gives scans");
    if (has_scanner && use_ != kUsePoints) {
      parameters().take_from_sensor("noise_m", scans_.noise_m());
      parameters().take_from_sensor("noise_per_m", scans_.noise_per_m());
      scan_options_.deskew = static_cast<Deskew>(deskew_);
      lidar_.emplace(scan_options_);
      return;
    }
    adapter_.activate(activation);
    options_.against = static_cast<Against>(against_);
    options_.metric = static_cast<Metric>(metric_);
    options_.kernel = static_cast<Kernel>(kernel_);
    localiser_.emplace(options_);
  }

  void deactivate() override {
    localiser_.reset();
    lidar_.reset();
  }

  void reset() override {
    if (lidar_) {
      lidar_->reset();
      scans_.reset();
      return;
    }
    localiser_->reset();
    adapter_.reset();
  }

  void process(const hw_frame_t& frame) override {
    if (lidar_) {
      process_scans(frame);
      return;
    }
    const Answer& answer = localiser_->process(adapter_.gather(frame));
    adapter_.put_pose(host(), frame, answer.has_pose, answer.T_map_sensor);
    if (options_.against == Against::map) adapter_.put_associations(host(), answer.associations);
    put_counters(answer.counters);
    host().put_map_epoch(answer.epoch);
  }

  void report(bool) override {
    if (lidar_) return;  // its map is the surroundings of the moment
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
  static constexpr int kUsePoints = 1, kUseScans = 2;

  /// A frame without a scan has no answer.
  void process_scans(const hw_frame_t& frame) {
    const ScanAnswer* answer = scans_.process(frame, *lidar_);
    if (answer == nullptr) return;
    scans_.put_pose(host(), frame, *answer);
    const ScanCounters& counters = answer->counters;
    const hw_counter_t list[] = {{"lost", static_cast<double>(counters.lost)},
                                 {"searches", static_cast<double>(counters.searches)},
                                 {"patches", static_cast<double>(counters.patches)},
                                 {"iterations", static_cast<double>(counters.iterations)},
                                 {"open_directions", static_cast<double>(counters.open)},
                                 {"deskew_source", static_cast<double>(counters.source)},
                                 {"residual_m", counters.residual_m},
                                 {"overlap", counters.overlap},
                                 {"sigma_m", counters.sigma_m},
                                 {"sigma_rad", counters.sigma_rad}};
    host().put_counters(list);
    host().put_map_epoch(answer->epoch);
  }

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
  ScanOptions scan_options_;
  int use_ = 0;
  int deskew_ = 0;
  ScanAdapter scans_;
  std::optional<LidarOdometry> lidar_;  // where a scanner localises
};

const hw_plugin_info_t* Icp::info() {
  static constexpr std::uint32_t kAnyOf[] = {HW_SAMPLE_POINTS, HW_SAMPLE_RANGE_SCAN, HW_SAMPLE_ODOMETRY,
                                             HW_SAMPLE_IMU};
  static constexpr std::uint32_t kOutputs[] = {HW_OUTPUT_POSE, HW_OUTPUT_LANDMARKS, HW_OUTPUT_ASSOCIATIONS,
                                               HW_OUTPUT_COUNTERS};
  static constexpr hw_plugin_info_t kInfo = [] {
    hw_plugin_info_t info = sdk::plugin_info(
        "icp", "Iterative closest point", "0.2.0", "Hallway",
        "Localises by registering each frame of points or scan with earlier ones.", kAnyOf, kOutputs, kAnyOf);
    info.inputs = nullptr;  // none of them alone is needed
    info.n_inputs = 0;
    return info;
  }();
  return &kInfo;
}

}  // namespace
}  // namespace hallway::icp

HALLWAY_PLUGINS(hallway::icp::Icp);
