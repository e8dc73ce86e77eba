// SPDX-License-Identifier: MIT
#include "geom/pose.hpp"

#include <cmath>

namespace hallway {

Pose Pose::operator*(const Pose& other) const {
  return {(q * other.q).normalized(), q * other.t + t};
}

Pose Pose::inverse() const {
  const Quat back = q.conjugate();
  return {back, -(back * t)};
}

Pose look_along(const Vec3& position, const Vec3& forward) {
  const Vec3 x = forward.normalized();
  Vec3 y = Vec3::UnitZ().cross(x);
  constexpr double kVertical =
      1e-9;  // sine of the angle to the vertical below which the heading is lost in rounding
  if (y.norm() < kVertical) y = Vec3::UnitY();
  y.normalize();
  Eigen::Matrix3d rotation;
  rotation << x, y, x.cross(y);
  return {Quat(rotation).normalized(), position};
}

Quat from_yaw_pitch_roll(double yaw, double pitch, double roll) {
  return Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
              Eigen::AngleAxisd(roll, Vec3::UnitX()));
}

double angle_between(const Quat& a, const Quat& b) {
  const Quat difference = a.conjugate() * b;
  return 2.0 * std::atan2(difference.vec().norm(), std::abs(difference.w()));
}

}  // namespace hallway
