// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

namespace hallway::icp {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Points = std::vector<Vec3>;

/// A rigid transform: `T_a_b * p_b` is the point in frame a. Metres; q is a unit quaternion.
struct Pose {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();  ///< rotation
  Vec3 t = Vec3::Zero();                                  ///< translation [m]

  Vec3 operator*(const Vec3& p) const { return q * p + t; }
  Pose operator*(const Pose& other) const { return {(q * other.q).normalized(), q * other.t + t}; }
  Pose inverse() const { return {q.conjugate(), -(q.conjugate() * t)}; }
};

/// Coordinates beyond this are taken for faults [m]: they leave a double no digits for what is near.
inline constexpr double kMaxCoordinate_m = 1e9;

/// Whether a point can be used: it is finite, and no coordinate is beyond kMaxCoordinate_m.
inline bool usable(const Vec3& p) {
  return p.cwiseAbs().maxCoeff() <= kMaxCoordinate_m && p.allFinite();
}

/// The usable points of a cloud, in their order.
inline Points usable_points(const Points& points) {
  Points kept;
  kept.reserve(points.size());
  for (const Vec3& p : points) {
    if (usable(p)) kept.push_back(p);
  }
  return kept;
}

/// The angle of a rotation by a unit quaternion [rad], in [0, pi].
inline double angle_of(const Eigen::Quaterniond& q) {
  return 2.0 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

}  // namespace hallway::icp
