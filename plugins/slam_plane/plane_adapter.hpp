// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "adapter/newest_sample.hpp"
#include "geometry/se3.hpp"
#include "slam_plane/core/types.hpp"

namespace hallway::slam_plane {

/// What the adapters of both mappers share: the sensor, its planes, and answers that are alike. `Observation` is what a mapper takes, `View` what bounds its frames.
template <typename Observation, typename View>
class PlaneAdapter {
 public:
  View& view() { return view_; }
  /// The largest standard deviation in the sensor's description, metres; NaN where it gives none.
  double noise_m() const { return noise_m_; }

  /// Answers which landmark each plane is associated with.
  void put_associations(const sdk::Host& host, const std::vector<LandmarkId>& landmarks) const {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const auto at = [&](std::size_t n) { return landmarks.begin() + static_cast<std::ptrdiff_t>(n); };
      const std::size_t end = i + 1 < samples_.size() ? samples_[i + 1].first : landmarks.size();
      host.put_associations(samples_[i].sample, std::vector<std::uint64_t>(at(samples_[i].first), at(end)));
    }
  }

 protected:
  /// Takes the sensor that gives planes, or else the one in whose points another plugin finds them. Throws sdk::Failure where there is not
  /// exactly one of the kind.
  const hw_sensor_info_t& take_sensor(const hw_activation_t& activation) {
    const hw_sensor_info_t* sensor = only_sensor(activation, HW_SAMPLE_PLANES);
    if (sensor == nullptr) sensor = only_sensor(activation, HW_SAMPLE_POINTS);
    if (sensor == nullptr) throw sdk::Failure(HW_ERROR_ARGUMENT, "no sensor gives planes or points");
    sensor_id_ = sensor->id;
    noise_m_ = sdk::largest_noise_m(*sensor);
    const auto& q = sensor->T_body_sensor.orientation;
    T_body_sensor_ = {Quat(q[0], q[1], q[2], q[3]), Vec3(sensor->T_body_sensor.position)};
    view_.horizontal_fov_rad = or_else(sensor->horizontal_fov, 2.0 * std::numbers::pi);
    view_.max_range_m = or_else(sensor->max_range_m, 0.0);
    return *sensor;
  }

  /// A number of the sensor's description, or what it is where that gives none.
  static double or_else(double given, double otherwise) { return std::isfinite(given) ? given : otherwise; }

  /// What `observe` makes of the planes of a frame, in their order, of the newest readings; it lives until the next call. Throws sdk::Failure for planes of a sensor that was not announced.
  template <typename Observe>
  const std::vector<Observation>& gather(const hw_frame_t& frame, const Observe& observe) {
    observations_.clear();
    samples_.clear();
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      if (sample.kind != HW_SAMPLE_PLANES || is_superseded(frame, k)) continue;
      if (sample.sensor_id != sensor_id_)
        throw sdk::Failure(HW_ERROR_DATA, "planes of sensor " + std::to_string(sample.sensor_id) +
                                              ", which is not the one that they are taken from");
      const auto& planes = *static_cast<const hw_planes_t*>(sample.payload);
      samples_.push_back({k, observations_.size()});
      for (std::uint64_t i = 0; i < planes.count; ++i)
        observations_.push_back(observe(planes, *hw_plane_at(&planes, i)));
    }
    return observations_;
  }

  /// Calls `take` with the points that bound a plane: of its hull where that is given, for the rectangle may lie askew, else its corners.
  template <typename Take>
  static void visit_bounds(const hw_planes_t& planes, const hw_plane_t& plane, const Take& take) {
    for (std::uint64_t i = 0; i < plane.n_hull; ++i) {
      hw_point3_t point;
      std::memcpy(&point,
                  static_cast<const char*>(planes.hull_points) + (plane.first_hull + i) * planes.hull_stride,
                  sizeof point);
      take(Vec3(point.x, point.y, point.z));
    }
    if (plane.n_hull > 0) return;
    for (const auto& corner : plane.corners) take(Vec3(corner));
  }

  static std::uint32_t status_of(LandmarkStatus status) {
    switch (status) {
      case LandmarkStatus::mapped:
        return HW_LANDMARK_MAPPED;
      case LandmarkStatus::dynamic:
        return HW_LANDMARK_DYNAMIC;
      case LandmarkStatus::temporary:
        break;
    }
    return HW_LANDMARK_TEMPORARY;
  }

  /// Answers the submaps of a map; `to_c` gives their poses as the ABI has them.
  template <typename Submaps, typename ToC>
  static void put_submaps(const sdk::Host& host, const Submaps& submaps, const ToC& to_c) {
    std::vector<hw_submap_t> list;
    std::vector<std::uint64_t> members;
    for (const auto& submap : submaps) {
      list.push_back({submap.id, to_c(submap.T_map_submap), members.size(), submap.members.size()});
      members.insert(members.end(), submap.members.begin(), submap.members.end());
    }
    host.put_submaps(list, members);
  }

  Pose T_body_sensor_;

 private:
  struct Sample {
    std::uint32_t sample;
    std::size_t first;  // of its observations
  };

  static const hw_sensor_info_t* only_sensor(const hw_activation_t& activation, std::uint32_t kind) {
    const hw_sensor_info_t* only = nullptr;
    for (std::uint32_t i = 0; i < activation.n_sensors; ++i) {
      if (activation.sensors[i]->kind != kind) continue;
      if (only != nullptr) throw sdk::Failure(HW_ERROR_ARGUMENT, "more than one sensor gives planes");
      only = activation.sensors[i];
    }
    return only;
  }

  std::uint32_t sensor_id_ = 0;
  double noise_m_ = std::nan("");
  View view_;
  std::vector<Observation> observations_;
  std::vector<Sample> samples_;
};

/// A count as counters of the ABI have it.
inline double number(std::uint64_t count) {
  return static_cast<double>(count);
}

}  // namespace hallway::slam_plane
