// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
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
      for (std::uint64_t i = 0; i < planes.count; ++i) pieces_.push_back(piece_of(*hw_plane_at(&planes, i)));
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

  /// The plane from its left to its right corner; without length, which no wall is, where it is no wall.
  static Piece piece_of(const hw_plane_t& plane) {
    const Vec2 normal(plane.normal[0], plane.normal[1]);
    Piece piece;
    if (normal.norm() < kLeastLevel) return piece;
    const Vec2 n = normal.normalized();
    const Vec2 d = left_of(n);  // of two walls that meet the robot's eye, from left to right
    const Vec2 centre(plane.centroid[0], plane.centroid[1]);
    double from = 0.0, to = 0.0;
    piece.z_low = piece.z_high = plane.corners[0][2];
    for (const auto& corner : plane.corners) {
      const double s = d.dot(Vec2(corner[0], corner[1]) - centre);
      from = std::min(from, s);
      to = std::max(to, s);
      piece.z_low = std::min(piece.z_low, corner[2]);
      piece.z_high = std::max(piece.z_high, corner[2]);
    }
    piece.a = centre + from * d;
    piece.b = centre + to * d;
    return piece;
  }

  std::uint32_t sensor_id_ = 0;
  Eigen::Quaterniond q_body_sensor_ = Eigen::Quaterniond::Identity();
  Vec3 t_body_sensor_ = Vec3::Zero();
  Pose2 T_body_sensor_;
  View view_;
  std::vector<Piece> pieces_;
  std::vector<Sample> samples_;
};

}  // namespace hallway::slam_plane
