// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::sense {

/// How a rigid body moves at one moment. SI units.
struct Kinematics {
  Pose T_world_body{};
  Vec3 velocity = Vec3::Zero();              ///< of the body's origin, world
  Vec3 acceleration = Vec3::Zero();          ///< of the body's origin, world
  Vec3 angular_velocity = Vec3::Zero();      ///< body frame
  Vec3 angular_acceleration = Vec3::Zero();  ///< body frame
};

/// Which limit is meant at a moment where a derivative of the motion, or the orientation itself, jumps.
enum class Side { kBefore, kAfter };

/// The true motion of a robot's body, for its sensors. A pure function of time.
class Trajectory {
 public:
  virtual ~Trajectory() = default;

  /// T_world_body at a time.
  virtual Pose pose_at(std::int64_t t_ns) const = 0;
  /// The motion `after_s` seconds after a time: two numbers, so that moments within a short interval are exact late in a run too.
  virtual Kinematics kinematics_at(std::int64_t t_ns, double after_s, Side side) const = 0;
  /// The moments in (begin, end] at which kinematics_at() is not smooth, ascending, in seconds after `begin_ns`. Between two of
  /// them all members have derivatives of every order.
  virtual std::vector<double> breaks_in(std::int64_t begin_ns, std::int64_t end_ns) const = 0;
};

}  // namespace hallway::sense
