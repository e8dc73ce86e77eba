// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/thesis/state.hpp"

namespace hallway::slam_plane::thesis {

/// Aligns the first submap to the planes of the first iteration, in whose robot frame the map is: notes which ends were static then (Rule 4).
void anchor_first(State& state);

/// Fixes submaps of State::unanchored where the robot's pose of now puts them: those that a motion model began (Rules 27, 29), and those that lost their link to older ones while
/// the map tells the pose. @returns how many.
std::uint64_t anchor_by_pose(const Alignment& location, State& state);

}  // namespace hallway::slam_plane::thesis
