// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "contact/twist_check.hpp"

namespace hallway::contact {

/// A part of a body's motion, given in closed form.
///
/// At a share s of its duration the body is where its twist brings it in the plane that it had at the beginning, moved by s * shift and
/// turned by s * turn about its origin: so it follows a floor that is no plane.
struct Part {
  std::int64_t begin_ns = 0;
  TwistRamp ramp{};           ///< of the body; its duration is the part's: 0 for a drop, which takes no time
  Pose from{};                ///< T_world_body at the beginning
  Pose to{};                  ///< at the end
  Vec3 shift = Vec3::Zero();  ///< world frame, metres
  Vec3 turn = Vec3::Zero();   ///< rotation vector, world frame

  std::int64_t end_ns() const { return begin_ns + ramp.duration_ns; }
};

/// A part that follows a ramp and ends at the pose `to`.
Part make_part(std::int64_t begin_ns, const Pose& from, const TwistRamp& ramp, const Pose& to);

/// A part that takes no time and leads straight from a pose to another.
Part make_drop(std::int64_t begin_ns, const Pose& from, const Pose& to);

/// The pose at a share of a part's duration, in [0, 1]; exactly `from` at 0 and `to` at 1.
Pose pose_in(const Part& part, double share);

/// How a body moves at one moment of a part. World frame, SI units.
struct PartMotion {
  Pose pose{};  ///< T_world_body
  Vec3 velocity = Vec3::Zero();
  Vec3 acceleration = Vec3::Zero();
  Vec3 angular_velocity = Vec3::Zero();
  Vec3 angular_acceleration = Vec3::Zero();
};

/// The derivatives of pose_in() by time; of a drop, which takes no time, rest at its end.
/// @param after_s  since the part's beginning, within its duration
PartMotion motion_in(const Part& part, double after_s);

/// A bound of how far points of a body leave the chord between where they are at 0 and at 1, at the same share; metres. Between two shares of
/// difference d it is d^2 of that.
/// @param radius  greatest distance of the body's points from its origin
double bend(const Part& part, double radius);

/// A bound of how far a part turns the body, radians.
double turning(const Part& part);

}  // namespace hallway::contact
