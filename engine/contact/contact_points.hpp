// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "contact/obstacles.hpp"

namespace hallway::contact {

/// A point of a body that must not move against a normal.
struct ContactPoint {
  Vec3 on_body = Vec3::Zero();  ///< world frame
  Vec3 on_obstacle = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< unit, from the obstacle to the body
  double gap = 0.0;             ///< normal . (on_body - on_obstacle), metres
  std::uint32_t obstacle = 0;   ///< index in Obstacles
  double drift_m_s = 0.0;       ///< away from the obstacle besides what a twist does at once; set by Mover
};

/// Where a body and a triangle are nearer than `range`: their nearest points; and of a polytope also those that would be nearest if it were turned by a
/// little about its z axis to either side, with the same normal. These are the ends of a side that lies flat on a wall or on a post, and keep the
/// body from turning into it. None if they are not that near, or overlap.
std::vector<ContactPoint> contact_points(const BodyShape& shape, const Pose& pose, const Obstacles& obstacles,
                                         std::uint32_t obstacle, double range);

}  // namespace hallway::contact
