// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/pose.h>

#include "geometry/se3.hpp"

namespace hallway {

/// A pose of the ABI as the plugins' libraries have it.
inline Pose to_pose(const hw_pose_t& pose) {
  const auto& q = pose.orientation;
  return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]),
          Vec3(pose.position[0], pose.position[1], pose.position[2])};
}

/// Between an algorithm that says where a sensor is and a host that asks where the body is: the algorithm's map begins in the sensor's frame, the host's in the body's at the same moment.
class BodyFrame {
 public:
  using Mat6 = Eigen::Matrix<double, 6, 6>;

  BodyFrame() = default;
  explicit BodyFrame(const Pose& T_body_sensor)
      : T_body_sensor_(T_body_sensor), T_sensor_body_(T_body_sensor.inverse()) {}

  const Pose& T_body_sensor() const { return T_body_sensor_; }
  const Pose& T_sensor_body() const { return T_sensor_body_; }

  /// T_map_body, in the ABI's form, of a sensor pose or of a submap's, which is one.
  hw_pose_t pose(const Pose& T_map_sensor) const {
    const Pose T = T_body_sensor_ * T_map_sensor * T_sensor_body_;
    return {{T.t.x(), T.t.y(), T.t.z()}, {T.q.w(), T.q.x(), T.q.y(), T.q.z()}};
  }

  /// The covariance of pose() from that of the sensor pose, as hw_pose_output_t has it; symmetric, so by rows or columns.
  Mat6 covariance(const Pose& T_map_sensor, const Mat6& of_sensor) const {
    const Mat3 turn = T_body_sensor_.q.toRotationMatrix();
    const Vec3 arm = T_map_sensor.q * T_sensor_body_.t;  // from the sensor to the body
    Mat3 cross;
    cross << 0.0, -arm.z(), arm.y(), arm.z(), 0.0, -arm.x(), -arm.y(), arm.x(), 0.0;
    Mat6 motion;
    motion << turn, -turn * cross, Mat3::Zero(), turn;
    const Mat6 moved = motion * of_sensor * motion.transpose();
    return 0.5 * (moved + moved.transpose());
  }

 private:
  Pose T_body_sensor_;
  Pose T_sensor_body_;
};

}  // namespace hallway
