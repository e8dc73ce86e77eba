// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "slam_plane/core/types.hpp"

namespace hallway::slam_plane {

/// Between the ABI and the mapper, which lives in a plane: pieces of walls are what level planes leave out of the planes of one upright
/// sensor, in that sensor's frame; answers are moved to the body, so that the map's frame is the body's at the frame that the map began with.
class PlaneAdapter {
 public:
  /// Takes the sensor that gives planes, or else the one in whose points another plugin finds them. Throws sdk::Failure where there is not
  /// exactly one of the kind, or where it is not mounted upright.
  void activate(const hw_activation_t& activation) {
    const hw_sensor_info_t* sensor = only_sensor(activation, HW_SAMPLE_PLANES);
    if (sensor == nullptr) sensor = only_sensor(activation, HW_SAMPLE_POINTS);
    if (sensor == nullptr) throw sdk::Failure(HW_ERROR_ARGUMENT, "no sensor gives planes or points");
    sensor_id_ = sensor->id;
    noise_m_ = sdk::largest_noise_m(*sensor);
    const auto& q = sensor->T_body_sensor.orientation;
    q_body_sensor_ = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    const auto& t = sensor->T_body_sensor.position;
    t_body_sensor_ = Vec3(t[0], t[1], t[2]);
    if ((q_body_sensor_ * Vec3::UnitZ()).z() < kUpright)
      throw sdk::Failure(HW_ERROR_ARGUMENT, "the sensor is not mounted upright");
    const Vec3 forward = q_body_sensor_ * Vec3::UnitX();
    T_body_sensor_ = Pose2::at(t_body_sensor_.head<2>(), std::atan2(forward.y(), forward.x()));
    view_.horizontal_fov_rad =
        std::isfinite(sensor->horizontal_fov) ? sensor->horizontal_fov : 2.0 * std::numbers::pi;
    view_.max_range_m = std::isfinite(sensor->max_range_m) ? sensor->max_range_m : 0.0;
  }

  View& view() { return view_; }
  /// The largest standard deviation that the sensor's description tells, metres; NaN where it tells none.
  double noise_m() const { return noise_m_; }

  /// The walls' pieces among the planes of a frame, in the sensor's frame; they live until the next call. Throws sdk::Failure for planes of a
  /// sensor that was not announced.
  const std::vector<Piece>& gather(const hw_frame_t& frame) {
    pieces_.clear();
    samples_.clear();
    for (std::uint32_t k = 0; k < frame.n_samples; ++k) {
      const hw_sample_t& sample = *frame.samples[k];
      if (sample.kind != HW_SAMPLE_PLANES) continue;
      if (sample.sensor_id != sensor_id_)
        throw sdk::Failure(HW_ERROR_DATA, "planes of sensor " + std::to_string(sample.sensor_id) +
                                              ", which is not the one that they are taken from");
      const auto& planes = *static_cast<const hw_planes_t*>(sample.payload);
      samples_.push_back({k, pieces_.size()});
      for (std::uint64_t i = 0; i < planes.count; ++i)
        pieces_.push_back(piece_of(planes, *hw_plane_at(&planes, i)));
    }
    return pieces_;
  }

  /// Answers which wall each plane was taken for.
  void put_associations(const sdk::Host& host, const std::vector<WallId>& walls) const {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const auto begin = walls.begin() + static_cast<std::ptrdiff_t>(samples_[i].first);
      const auto end = i + 1 < samples_.size()
                           ? walls.begin() + static_cast<std::ptrdiff_t>(samples_[i + 1].first)
                           : walls.end();
      host.put_associations(samples_[i].sample, std::vector<std::uint64_t>(begin, end));
    }
  }

  /// Answers the walls of a map as upright rectangles.
  void put_walls(const sdk::Host& host, const std::vector<Wall>& walls) const {
    std::vector<hw_mapped_plane_t> planes;
    std::vector<hw_mapped_corner_t> corners;
    for (const Wall& wall : walls) {
      const Vec2 a = T_body_sensor_ * wall.a, b = T_body_sensor_ * wall.b;
      if ((b - a).norm() < kLeastLength) continue;
      const Vec2 normal = -left_of((b - a).normalized());
      hw_mapped_plane_t& plane = planes.emplace_back();
      plane = {wall.id,
               {normal.x(), normal.y(), 0.0},
               normal.dot(a),
               wall.observations,
               status_of(wall.status),
               corners.size(),
               4};
      const double low = wall.z_low + t_body_sensor_.z(), high = wall.z_high + t_body_sensor_.z();
      corners.push_back({{a.x(), a.y(), low}, 0, 0});
      corners.push_back({{b.x(), b.y(), low}, wall.certain[kEndB] ? HW_EDGE_CERTAIN : 0, 0});
      corners.push_back({{b.x(), b.y(), high}, 0, 0});
      corners.push_back({{a.x(), a.y(), high}, wall.certain[kEndA] ? HW_EDGE_CERTAIN : 0, 0});
    }
    host.put_mapped_planes(planes, corners);
  }

  /// T_map_body of a sensor pose or of a submap's, which is one.
  Pose2 body_pose(const Pose2& T_map_sensor) const {
    return T_body_sensor_ * T_map_sensor * T_body_sensor_.inverse();
  }
  static hw_pose_t to_c(const Pose2& T) {
    const double half = 0.5 * T.heading();
    return {{T.t.x(), T.t.y(), 0.0}, {std::cos(half), 0.0, 0.0, std::sin(half)}};
  }

  /// The covariance of body_pose(), as hw_pose_output_t has it, from that of the sensor's x, y and heading.
  Eigen::Matrix<double, 6, 6> body_covariance(const Pose2& T_map_sensor, const Mat3& covariance) const {
    const Vec2 arm = left_of(T_map_sensor.rotate(T_body_sensor_.inverse().t));
    Mat3 motion = Mat3::Identity();
    motion.topRightCorner<2, 1>() = arm;
    Mat3 turn = Mat3::Identity();
    turn.topLeftCorner<2, 2>() << T_body_sensor_.r.x(), -T_body_sensor_.r.y(), T_body_sensor_.r.y(),
        T_body_sensor_.r.x();
    const Mat3 c = turn * motion * covariance * motion.transpose() * turn.transpose();
    Eigen::Matrix<double, 6, 6> all = Eigen::Matrix<double, 6, 6>::Zero();
    const int at[3] = {0, 1, 5};
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) all(at[i], at[k]) = 0.5 * (c(i, k) + c(k, i));
    }
    return all;
  }

 private:
  static constexpr double kUpright = 0.999;   // cosine of the largest tilt of the sensor
  static constexpr double kLeastLevel = 0.9;  // length of a wall's normal within the level

  static constexpr double kLeastLength = 1e-6;  // of a wall that has a direction [m]

  static std::uint32_t status_of(WallStatus status) {
    switch (status) {
      case WallStatus::mapped:
        return HW_LANDMARK_MAPPED;
      case WallStatus::dynamic:
        return HW_LANDMARK_DYNAMIC;
      case WallStatus::temporary:
        break;
    }
    return HW_LANDMARK_TEMPORARY;
  }

  struct Sample {
    std::uint32_t sample;
    std::size_t first;  // of its pieces
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

  /// Calls `take` with the points that bound a plane: of its hull where that is told, for the rectangle may lie askew, else its corners.
  template <typename Take>
  static void visit_bounds(const hw_planes_t& planes, const hw_plane_t& plane, Take take) {
    for (std::uint64_t i = 0; i < plane.n_hull; ++i) {
      const char* at =
          static_cast<const char*>(planes.hull_points) + (plane.first_hull + i) * planes.hull_stride;
      hw_point3_t point;
      std::memcpy(&point, at, sizeof point);
      take(Vec3(point.x, point.y, point.z));
    }
    if (plane.n_hull > 0) return;
    for (const auto& corner : plane.corners) take(Vec3(corner[0], corner[1], corner[2]));
  }

  /// The plane from its left to its right end; without length, which no wall is, where it is no wall.
  static Piece piece_of(const hw_planes_t& planes, const hw_plane_t& plane) {
    const Vec2 normal(plane.normal[0], plane.normal[1]);
    Piece piece;
    if (normal.norm() < kLeastLevel) return piece;
    const Vec2 n = normal.normalized();
    const Vec2 d = left_of(n);  // of two walls that meet the robot's eye, from left to right
    const Vec2 centre(plane.centroid[0], plane.centroid[1]);
    double from = 0.0, to = 0.0;
    piece.z_low = piece.z_high = plane.centroid[2];
    visit_bounds(planes, plane, [&](const Vec3& point) {
      const double s = d.dot(point.head<2>() - centre);
      from = std::min(from, s);
      to = std::max(to, s);
      piece.z_low = std::min(piece.z_low, point.z());
      piece.z_high = std::max(piece.z_high, point.z());
    });
    piece.a = centre + from * d;
    piece.b = centre + to * d;
    return piece;
  }

  std::uint32_t sensor_id_ = 0;
  double noise_m_ = std::nan("");
  Eigen::Quaterniond q_body_sensor_ = Eigen::Quaterniond::Identity();
  Vec3 t_body_sensor_ = Vec3::Zero();
  Pose2 T_body_sensor_;
  View view_;
  std::vector<Piece> pieces_;
  std::vector<Sample> samples_;
};

}  // namespace hallway::slam_plane
