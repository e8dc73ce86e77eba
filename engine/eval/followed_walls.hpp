// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "eval/driven_way.hpp"
#include "eval/floor_plan.hpp"

namespace hallway::eval {

/// A wall that a robot had on its right and drove along.
struct FollowedWall {
  std::size_t wall = 0;        ///< index in FloorPlan::walls()
  std::size_t first_pose = 0;  ///< indices in DrivenWay::poses(): the first and the last abreast of it
  std::size_t last_pose = 0;
  double first_along_m = 0.0;  ///< what was abreast then, from the wall's start
  double last_along_m = 0.0;
};

/// The walls that a robot followed, in the order of the way; no two in a row are the same.
///
/// A pose is abreast of a wall if the ray to the robot's right meets that wall first, within reach, and the heading is within 40 degrees of the
/// wall; the bend that a wall begins with does not count. A wall is followed where the way from its first to its last pose is 0.1 m, or half of a shorter wall: turns in place and
/// reverses follow nothing. O(poses * segments).
std::vector<FollowedWall> find_followed_walls(const FloorPlan& plan, const DrivenWay& way, double reach_m);

}  // namespace hallway::eval
