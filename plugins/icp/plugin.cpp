// SPDX-License-Identifier: MIT
#include <hallway/plugin.hpp>

#include <optional>
#include <string>
#include <vector>

#include "icp/core/localiser.hpp"

namespace hallway::icp {
namespace {

constexpr const char* kAgainst[] = {"previous", "keyframe", "map"};
constexpr const char* kMetrics[] = {"point_to_point", "point_to_plane"};
constexpr const char* kKernels[] = {"none", "huber", "cauchy", "tukey"};

Pose to_pose(const hw_pose_t& pose) {
  const auto& q = pose.orientation;
  return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]),
          Vec3(pose.position[0], pose.position[1], pose.position[2])};
}

hw_pose_t to_c(const Pose& pose) {
  return {{pose.t.x(), pose.t.y(), pose.t.z()}, {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()}};
}

/// The localiser behind the plugin ABI. It is fed with points in the frame of the first point sensor (what other sensors see is moved
/// there); its answers are moved to the body, so that the map's frame is the body's at the frame that it began with.
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
    for (const Parameter& row : icp::parameters()) {
      if (row.real) {
        parameters().add(row.name, &(options_.*row.real), row.min, row.max, row.unit, row.help);
      } else {
        parameters().add(row.name, &(options_.*row.whole), static_cast<int>(row.min),
                         static_cast<int>(row.max), row.unit, row.help);
      }
    }
  }

  void activate(const hw_activation_t& activation) override {
    sensors_.clear();
    for (std::uint32_t i = 0; i < activation.n_sensors; ++i) {
      const hw_sensor_info_t& sensor = *activation.sensors[i];
      if (sensor.kind == HW_SAMPLE_POINTS) add_sensor(sensor);
    }
    if (sensors_.empty()) throw sdk::Failure(HW_ERROR_ARGUMENT, "no sensor gives points");
    options_.against = static_cast<Against>(against_);
    options_.metric = static_cast<Metric>(metric_);
    options_.kernel = static_cast<Kernel>(kernel_);
    localiser_.emplace(options_);
    lost_ = false;
  }

  void deactivate() override { localiser_.reset(); }

  void reset() override {
    localiser_->reset();
    lost_ = false;
  }

  void process(const hw_frame_t& frame) override {
    gather_points(frame);
    const Answer& answer = localiser_->process(points_);
    put_pose(answer, frame);
    if (options_.against == Against::map) put_associations(answer);
    put_counters(answer.counters);
  }

  void report(bool) override {
    std::vector<hw_landmark_t> landmarks;
    for (const Landmark& landmark : localiser_->landmarks()) {
      const Vec3 p = T_body_reference_ * landmark.position;
      const bool mapped = landmark.observations >= static_cast<std::uint32_t>(options_.min_observations);
      landmarks.push_back({landmarks.size(),
                           {p.x(), p.y(), p.z()},
                           landmark.observations,
                           mapped ? HW_LANDMARK_MAPPED : HW_LANDMARK_TEMPORARY});
    }
    host().put_landmarks(landmarks);
  }

 private:
  struct Sensor {
    std::uint32_t id;
    Pose T_reference_sensor;
  };
  /// Which points of `points_` a sample gave.
  struct Range {
    std::uint32_t sample;
    std::size_t begin, end;
  };

  void add_sensor(const hw_sensor_info_t& info) {
    const Pose T_body_sensor = to_pose(info.T_body_sensor);
    if (sensors_.empty()) {
      T_body_reference_ = T_body_sensor;
      T_reference_body_ = T_body_sensor.inverse();
    }
    sensors_.push_back({info.id, sensors_.empty() ? Pose{} : T_reference_body_ * T_body_sensor});
  }

  const Sensor& find_sensor(std::uint32_t id) const {
    for (const Sensor& sensor : sensors_) {
      if (sensor.id == id) return sensor;
    }
    throw sdk::Failure(HW_ERROR_DATA,
                       "a sample of sensor " + std::to_string(id) + ", which was not announced");
  }

  void gather_points(const hw_frame_t& frame) {
    points_.clear();
    ranges_.clear();
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      if (sample.kind != HW_SAMPLE_POINTS) continue;
      const Sensor& sensor = find_sensor(sample.sensor_id);
      const bool is_reference = &sensor == &sensors_.front();
      const auto& points = *static_cast<const hw_points_t*>(sample.payload);
      ranges_.push_back({k, points_.size(), points_.size() + points.count});
      for (std::uint64_t i = 0; i < points.count; ++i) {
        const hw_point3_t& p = *hw_point_at(&points, i);
        const Vec3 point(p.x, p.y, p.z);
        points_.push_back(is_reference ? point : sensor.T_reference_sensor * point);
      }
    }
  }

  void put_pose(const Answer& answer, const hw_frame_t& frame) {
    if (answer.has_pose) {
      host().put_pose(to_c(T_body_reference_ * answer.T_map_sensor * T_reference_body_));
    } else {
      host().put_lost();
    }
    if (lost_ == answer.has_pose) {
      lost_ = !answer.has_pose;
      const std::string what = lost_ ? " determines no pose" : " has a pose again";
      host().log(lost_ ? HW_LOG_WARNING : HW_LOG_INFO, "frame " + std::to_string(frame.sequence) + what);
    }
  }

  void put_associations(const Answer& answer) {
    static_assert(kNoLandmark == HW_NO_LANDMARK);
    for (const Range& range : ranges_) {
      const auto first = answer.associations.begin();
      associations_.assign(first + static_cast<std::ptrdiff_t>(range.begin),
                           first + static_cast<std::ptrdiff_t>(range.end));
      host().put_associations(range.sample, associations_);
    }
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
  std::optional<Localiser> localiser_;
  std::vector<Sensor> sensors_;  ///< those that give points; the first one is the reference
  Pose T_body_reference_;
  Pose T_reference_body_;
  bool lost_ = false;
  Points points_;  ///< of this frame, in the reference sensor's frame
  std::vector<Range> ranges_;
  std::vector<std::uint64_t> associations_;
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
