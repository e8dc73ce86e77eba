// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "slam_plane/spatial/mapper.hpp"

namespace hallway::slam_plane {

/// Between the ABI and the mapper of faces: planes go in as they are, in the sensor's frame, with the hull as their outline where it is told; answers are
/// moved to the body, so that the map's frame is the body's at the frame that the map began with.
class SpatialAdapter {
 public:
  /// Takes the sensor that gives planes, or else the one in whose points another plugin finds them. Throws sdk::Failure where there is not
  /// exactly one of the kind.
  void activate(const hw_activation_t& activation) {
    const hw_sensor_info_t* sensor = only_sensor(activation, HW_SAMPLE_PLANES);
    if (sensor == nullptr) sensor = only_sensor(activation, HW_SAMPLE_POINTS);
    if (sensor == nullptr) throw sdk::Failure(HW_ERROR_ARGUMENT, "no sensor gives planes or points");
    sensor_id_ = sensor->id;
    noise_m_ = sdk::largest_noise_m(*sensor);
    const auto& q = sensor->T_body_sensor.orientation;
    const auto& t = sensor->T_body_sensor.position;
    T_body_sensor_ = {spatial::Quat(q[0], q[1], q[2], q[3]), Vec3(t[0], t[1], t[2])};
    const auto angle = [](double told) { return std::isfinite(told) ? told : 2.0 * std::numbers::pi; };
    view_.horizontal_fov_rad = angle(sensor->horizontal_fov);
    view_.vertical_fov_rad = angle(sensor->vertical_fov);
    view_.min_range_m = std::isfinite(sensor->min_range_m) ? sensor->min_range_m : 0.0;
    view_.max_range_m = std::isfinite(sensor->max_range_m) ? sensor->max_range_m : 0.0;
  }

  spatial::View& view() { return view_; }
  /// The largest standard deviation that the sensor's description tells, metres; NaN where it tells none.
  double noise_m() const { return noise_m_; }

  /// The planes of a frame; they live until the next call. Throws sdk::Failure for planes of a sensor that was not announced.
  const std::vector<spatial::Face>& gather(const hw_frame_t& frame) {
    faces_.clear();
    samples_.clear();
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      if (sample.kind != HW_SAMPLE_PLANES) continue;
      if (sample.sensor_id != sensor_id_)
        throw sdk::Failure(HW_ERROR_DATA, "planes of sensor " + std::to_string(sample.sensor_id) +
                                              ", which is not the one that they are taken from");
      const auto& planes = *static_cast<const hw_planes_t*>(sample.payload);
      samples_.push_back({k, faces_.size()});
      for (std::uint64_t i = 0; i < planes.count; ++i)
        faces_.push_back(face_of(planes, *hw_plane_at(&planes, i)));
    }
    return faces_;
  }

  void put_answer(const sdk::Host& host, const spatial::Answer& answer) const {
    if (answer.has_pose) {
      const spatial::Mat6 covariance = body_covariance(answer);
      host.put_pose(to_c(body_pose(answer.T_map_robot)), covariance.data());
    } else {
      host.put_lost();
    }
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const auto end = i + 1 < samples_.size() ? samples_[i + 1].first : answer.associations.size();
      host.put_associations(samples_[i].sample, std::vector<std::uint64_t>(
                                                    answer.associations.begin() + offset(samples_[i].first),
                                                    answer.associations.begin() + offset(end)));
    }
    const spatial::Counters& counters = answer.counters;
    const Vec3 open = T_body_sensor_.q * answer.undetermined;
    const hw_counter_t list[] = {
        {"lost", static_cast<double>(counters.lost)},
        {"faces", static_cast<double>(counters.faces)},
        {"submaps", static_cast<double>(counters.submaps)},
        {"closes", static_cast<double>(counters.closes)},
        {"reopened", static_cast<double>(counters.reopened)},
        {"degenerate", static_cast<double>(counters.degenerate)},
        {"global_steps", static_cast<double>(counters.global_steps)},
        {"merged", static_cast<double>(counters.merged)},
        {"edges", static_cast<double>(counters.edges)},
        {"edges_revoked", static_cast<double>(counters.edges_revoked)},
        {"dynamic", static_cast<double>(counters.dynamic)},
        {"found_again", static_cast<double>(counters.found_again)},
        {"undetermined", static_cast<double>(answer.open)},
        {"undetermined_x", open.x()},
        {"undetermined_y", open.y()},
        {"undetermined_z", open.z()},
    };
    host.put_counters(list);
  }

  void put_map(const sdk::Host& host, const spatial::Map& map) const {
    std::vector<hw_submap_t> submaps;
    std::vector<std::uint64_t> members;
    for (const spatial::MappedSubmap& submap : map.submaps) {
      submaps.push_back(
          {submap.id, to_c(body_pose(submap.T_map_submap)), members.size(), submap.members.size()});
      members.insert(members.end(), submap.members.begin(), submap.members.end());
    }
    put_faces(host, map.faces);
    host.put_submaps(submaps, members);
  }

 private:
  struct Sample {
    std::uint32_t sample;
    std::size_t first;  // of its faces
  };

  static std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  static const hw_sensor_info_t* only_sensor(const hw_activation_t& activation, std::uint32_t kind) {
    const hw_sensor_info_t* only = nullptr;
    for (std::uint32_t i = 0; i < activation.n_sensors; ++i) {
      if (activation.sensors[i]->kind != kind) continue;
      if (only != nullptr) throw sdk::Failure(HW_ERROR_ARGUMENT, "more than one sensor gives planes");
      only = activation.sensors[i];
    }
    return only;
  }

  static spatial::Face face_of(const hw_planes_t& planes, const hw_plane_t& plane) {
    spatial::Face face;
    face.normal = Vec3(plane.normal).normalized();
    face.centre = Vec3(plane.centroid);
    for (std::uint64_t i = 0; i < plane.n_hull; ++i) {
      hw_point3_t point;
      std::memcpy(&point,
                  static_cast<const char*>(planes.hull_points) + (plane.first_hull + i) * planes.hull_stride,
                  sizeof point);
      face.outline.emplace_back(point.x, point.y, point.z);
    }
    if (plane.n_hull > 0) return face;
    for (const auto& corner : plane.corners) face.outline.emplace_back(corner);
    return face;
  }

  spatial::Pose3 body_pose(const spatial::Pose3& T_map_sensor) const {
    return T_body_sensor_ * T_map_sensor * T_body_sensor_.inverse();
  }

  static hw_pose_t to_c(const spatial::Pose3& T) {
    return {{T.t.x(), T.t.y(), T.t.z()}, {T.q.w(), T.q.x(), T.q.y(), T.q.z()}};
  }

  /// The covariance of body_pose(), whose axes are those of the body at the start.
  spatial::Mat6 body_covariance(const spatial::Answer& answer) const {
    const Vec3 arm = answer.T_map_robot.q * T_body_sensor_.inverse().t;  // from sensor to body
    spatial::Mat6 motion = spatial::Mat6::Identity();
    motion.topRightCorner<3, 3>() << 0.0, arm.z(), -arm.y(), -arm.z(), 0.0, arm.x(), arm.y(), -arm.x(), 0.0;
    spatial::Mat6 turn = spatial::Mat6::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = T_body_sensor_.q.toRotationMatrix();
    const spatial::Mat6 all = turn * motion;
    const spatial::Mat6 c = all * answer.covariance * all.transpose();
    return 0.5 * (c + c.transpose());
  }

  /// The edge whose middle is lowest: of an upright wall its bottom, with which outlines begin.
  std::size_t lowest_edge(const std::vector<Vec3>& outline) const {
    std::size_t lowest = 0;
    double least = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec3 twice = T_body_sensor_.q * (outline[i] + outline[(i + 1) % outline.size()]);
      if (i > 0 && twice.z() >= least) continue;
      least = twice.z();
      lowest = i;
    }
    return lowest;
  }

  static std::uint32_t status_of(WallStatus status) {
    switch (status) {
      case WallStatus::mapped:
        return HW_LANDMARK_MAPPED;
      case WallStatus::dynamic:
        return HW_LANDMARK_DYNAMIC;
      default:
        return HW_LANDMARK_TEMPORARY;
    }
  }

  void put_faces(const sdk::Host& host, const std::vector<spatial::MappedFace>& faces) const {
    std::vector<hw_mapped_plane_t> planes;
    std::vector<hw_mapped_corner_t> corners;
    for (const spatial::MappedFace& face : faces) {
      const Vec3 n = (T_body_sensor_.q * face.normal).normalized();
      hw_mapped_plane_t& plane = planes.emplace_back();
      plane = {face.id,
               {n.x(), n.y(), n.z()},
               n.dot(T_body_sensor_ * face.outline.front()),
               face.observations,
               status_of(face.status),
               corners.size(),
               face.outline.size()};
      const std::size_t count = face.outline.size(), first = lowest_edge(face.outline);
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = (first + k) % count;
        const Vec3 p = T_body_sensor_ * face.outline[i];
        corners.push_back({{p.x(), p.y(), p.z()}, face.certain[i] ? HW_EDGE_CERTAIN : 0u, 0});
      }
    }
    host.put_mapped_planes(planes, corners);
  }

  std::uint32_t sensor_id_ = 0;
  double noise_m_ = std::nan("");
  spatial::Pose3 T_body_sensor_;
  spatial::View view_;
  std::vector<spatial::Face> faces_;
  std::vector<Sample> samples_;
};

}  // namespace hallway::slam_plane
