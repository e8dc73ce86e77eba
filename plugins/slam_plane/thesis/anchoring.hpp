// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/thesis/state.hpp"

namespace hallway::slam_plane::thesis {

/// Aligns the first submap to the planes of the first iteration, in whose robot frame the map is: notes which ends were static then (Rule 4).
void anchor_first(const Options& options, State& state);

/// Fixes submaps that a motion model began where the robot's pose of now puts them (Rules 27, 29). @returns how many.
std::uint64_t anchor_after_motion(const Pose2& T_map_robot, const Options& options, State& state);

}  // namespace hallway::slam_plane::thesis
