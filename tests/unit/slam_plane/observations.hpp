// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/core/observation.hpp"

namespace hallway::slam_plane::test {

/// An observation of the segment a->b, no corners.
inline AssociatedObservation observation(const Vec2& a, const Vec2& b) {
  AssociatedObservation s;
  s.end[kEndA] = a;
  s.end[kEndB] = b;
  s.middle = 0.5 * (a + b);
  s.length = (b - a).norm();
  s.direction = (b - a) / s.length;
  s.z_high = 2.5;
  return s;
}

/// The same seen by a robot at T_world_robot, with corners.
inline AssociatedObservation seen(const Pose2& T_world_robot, const Vec2& a, const Vec2& b,
                                  bool corner_a = false, bool corner_b = false) {
  const Pose2 T = T_world_robot.inverse();
  AssociatedObservation s = observation(T * a, T * b);
  s.corner[kEndA] = corner_a;
  s.corner[kEndB] = corner_b;
  return s;
}

}  // namespace hallway::slam_plane::test
