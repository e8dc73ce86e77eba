// SPDX-License-Identifier: MIT
#include "geometry/se3.hpp"

#include <cmath>

namespace hallway {

Pose look_along(const Vec3& position, const Vec3& forward) {
  const Vec3 x = forward.normalized();
  Vec3 y = Vec3::UnitZ().cross(x);
  constexpr double kVertical =
      1e-9;  // sine of the angle to the vertical below which the heading is lost in rounding
  if (y.norm() < kVertical) y = Vec3::UnitY();
  y.normalize();
  Mat3 rotation;
  rotation << x, y, x.cross(y);
  return {Quat(rotation).normalized(), position};
}

Quat from_yaw_pitch_roll(double yaw, double pitch, double roll) {
  return Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
              Eigen::AngleAxisd(roll, Vec3::UnitX()));
}

Quat rotation_by(const Vec3& vector) {
  const double angle = vector.norm();
  if (angle < 1e-12) return Quat(1.0, 0.5 * vector.x(), 0.5 * vector.y(), 0.5 * vector.z()).normalized();
  return Quat(Eigen::AngleAxisd(angle, vector / angle));
}

Vec3 rotation_vector(const Quat& q) {
  const Eigen::AngleAxisd turn(q.w() < 0.0 ? Quat(-q.w(), -q.x(), -q.y(), -q.z()) : q);
  return turn.angle() * turn.axis();
}

double angle_of(const Quat& q) {
  return 2.0 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

double angle_between(const Quat& a, const Quat& b) {
  return angle_of(a.conjugate() * b);
}

}  // namespace hallway
