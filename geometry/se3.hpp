// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace hallway {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// A rigid motion T_a_b: maps coordinates in frame b (metres) into frame a, x_a = q x_b + t. `q` is a unit quaternion. All of it is inline: it stands in
/// innermost loops.
struct Pose {
  Quat q = Quat::Identity();
  Vec3 t = Vec3::Zero();

  /// Maps a point.
  Vec3 operator*(const Vec3& point) const { return q * point + t; }
  /// T_a_c = T_a_b * T_b_c; the product's quaternion is normalised again, so that long chains stay rotations.
  Pose operator*(const Pose& other) const { return {(q * other.q).normalized(), q * other.t + t}; }
  /// T_b_a.
  Pose inverse() const { return {q.conjugate(), -(q.conjugate() * t)}; }
};

/// The pose at `position` that looks along `forward` (x axis), with its y axis level and its z axis as far up as that
/// allows. A forward direction straight up or down takes y as the world's y axis. `forward` need not have unit length, but
/// must not be zero.
Pose look_along(const Vec3& position, const Vec3& forward);

/// The rotation that turns by `yaw` about z, then `pitch` about the new y (positive looks down), then `roll` about the new
/// x, in radians.
Quat from_yaw_pitch_roll(double yaw, double pitch, double roll);

/// The rotation by a rotation vector [rad]: exp of so(3).
Quat rotation_by(const Vec3& vector);

/// The rotation vector of a rotation, of at most half a turn [rad]: log of SO(3).
Vec3 rotation_vector(const Quat& q);

/// The angle of a rotation, in [0, pi].
double angle_of(const Quat& q);

/// The angle of the rotation that leads from `a` to `b`, in [0, pi].
double angle_between(const Quat& a, const Quat& b);

}  // namespace hallway
