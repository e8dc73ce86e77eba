// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "slam_plane/plane_adapter.hpp"

namespace hallway::slam_plane {

/// Between the ABI and the mappers of walls, which live in a plane: wall observations are what level planes leave out of the planes of one upright
/// sensor, in that sensor's frame; answers are moved to the body, so that the map's frame is the body's at the frame that the map began with.
class WallAdapter : public PlaneAdapter<WallObservation, View> {
 public:
  /// Throws sdk::Failure as take_sensor() does, and where the sensor is not mounted upright.
  void activate(const hw_activation_t& activation) {
    take_sensor(activation);
    if ((T_body_sensor_.q * Vec3::UnitZ()).z() < kUpright)
      throw sdk::Failure(HW_ERROR_ARGUMENT, "the sensor is not mounted upright");
    const Vec3 forward = T_body_sensor_.q * Vec3::UnitX();
    level_ = Pose2::at(T_body_sensor_.t.head<2>(), std::atan2(forward.y(), forward.x()));
  }

  const std::vector<WallObservation>& gather(const hw_frame_t& frame) {
    return PlaneAdapter::gather(frame, observation_of);
  }

  void put_pose(const sdk::Host& host, const Answer& answer) const {
    if (!answer.has_pose) return host.put_lost();
    const Eigen::Matrix<double, 6, 6> covariance = body_covariance(answer);
    host.put_pose(body_pose(answer.T_map_robot), covariance.data());
  }

  /// Answers the walls of a map as upright rectangles.
  void put_landmarks(const sdk::Host& host, const std::vector<WallLandmark>& walls) const {
    std::vector<hw_mapped_plane_t> planes;
    std::vector<hw_mapped_corner_t> corners;
    for (const WallLandmark& wall : walls) {
      const Vec2 a = level_ * wall.a, b = level_ * wall.b;
      if ((b - a).norm() < kLeastLength) continue;
      const Vec2 normal = -left_of((b - a).normalized());
      planes.push_back({wall.id,
                        {normal.x(), normal.y(), 0.0},
                        normal.dot(a),
                        wall.observations,
                        status_of(wall.status),
                        corners.size(),
                        4});
      const double low = wall.z_low + T_body_sensor_.t.z(), high = wall.z_high + T_body_sensor_.t.z();
      corners.push_back({{a.x(), a.y(), low}, 0, 0});
      corners.push_back({{b.x(), b.y(), low}, wall.certain[kEndB] ? HW_EDGE_CERTAIN : 0, 0});
      corners.push_back({{b.x(), b.y(), high}, 0, 0});
      corners.push_back({{a.x(), a.y(), high}, wall.certain[kEndA] ? HW_EDGE_CERTAIN : 0, 0});
    }
    host.put_mapped_planes(planes, corners);
  }

  void put_submaps(const sdk::Host& host, const std::vector<Submap>& submaps) const {
    PlaneAdapter::put_submaps(host, submaps, [this](const Pose2& T) { return body_pose(T); });
  }

 private:
  static constexpr double kUpright = 0.999;     // cosine of the largest tilt of the sensor
  static constexpr double kLeastLevel = 0.9;    // length of a wall's normal within the level
  static constexpr double kLeastLength = 1e-6;  // of a wall that has a direction [m]

  /// The plane from its left to its right end; without length, which no wall is, where it is no wall.
  static WallObservation observation_of(const hw_planes_t& planes, const hw_plane_t& plane) {
    const Vec2 normal(plane.normal[0], plane.normal[1]);
    WallObservation observation;
    if (normal.norm() < kLeastLevel) return observation;
    const Vec2 n = normal.normalized();
    const Vec2 d = left_of(n);  // of two walls that meet the robot's eye, from left to right
    const Vec2 centre(plane.centroid[0], plane.centroid[1]);
    double from = 0.0, to = 0.0;
    observation.z_low = observation.z_high = plane.centroid[2];
    visit_bounds(planes, plane, [&](const Vec3& point) {
      const double s = d.dot(point.head<2>() - centre);
      from = std::min(from, s);
      to = std::max(to, s);
      observation.z_low = std::min(observation.z_low, point.z());
      observation.z_high = std::max(observation.z_high, point.z());
    });
    observation.a = centre + from * d;
    observation.b = centre + to * d;
    return observation;
  }

  /// T_map_body of a sensor pose or of a submap's, which is one.
  hw_pose_t body_pose(const Pose2& T_map_sensor) const {
    const Pose2 T = level_ * T_map_sensor * level_.inverse();
    const double half = 0.5 * T.heading();
    return {{T.t.x(), T.t.y(), 0.0}, {std::cos(half), 0.0, 0.0, std::sin(half)}};
  }

  /// The covariance of body_pose(), as hw_pose_output_t has it, from that of the sensor's x, y and heading.
  Eigen::Matrix<double, 6, 6> body_covariance(const Answer& answer) const {
    Mat3 motion = Mat3::Identity();
    motion.topRightCorner<2, 1>() = left_of(answer.T_map_robot.rotate(level_.inverse().t));
    Mat3 turn = Mat3::Identity();
    turn.topLeftCorner<2, 2>() << level_.r.x(), -level_.r.y(), level_.r.y(), level_.r.x();
    const Mat3 c = turn * motion * answer.covariance * motion.transpose() * turn.transpose();
    Eigen::Matrix<double, 6, 6> all = Eigen::Matrix<double, 6, 6>::Zero();
    const int at[3] = {0, 1, 5};
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) all(at[i], at[k]) = 0.5 * (c(i, k) + c(k, i));
    }
    return all;
  }

  Pose2 level_;  // T_body_sensor_ without what is not in the level
};

}  // namespace hallway::slam_plane
