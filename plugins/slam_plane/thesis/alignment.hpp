// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "slam_plane/core/types.hpp"

namespace hallway::slam_plane::thesis {

/// One plane in two frames: what tells how the frames lie to each other.
struct PlanePair {
  Vec2 direction[2] = {Vec2(1.0, 0.0), Vec2(1.0, 0.0)};  ///< unit, in the frame `from` and in the frame `to`
  Vec2 point[2] = {Vec2::Zero(),
                   Vec2::Zero()};  ///< the same point of the plane in both, or any two of its line [m]
  bool same_point = false;         ///< the points are one: they tell the place along the plane too
};

/// What a set of pairs tells.
struct Alignment {
  Pose2 T_to_from;
  bool determined = false;   ///< else the place along `open` is the one that was given
  Vec2 open = Vec2::Zero();  ///< unit, frame `to`
  bool by_points = false;    ///< same points told the place, and not lines alone
};

/// Cosine and sine of the mean turn of the pairs' directions.
Vec2 mean_rotation(std::span<const PlanePair> pairs);

/// Leaves out the points that tell a place farther than a bound from the guess's, if others tell one that is nearer.
void leave_out_jumps(const Pose2& guess, double bound_m, std::vector<PlanePair>& pairs);

/// The rigid motion between two frames: the mean of the directions' differences, then the mean of the points' (Rules 4, 5, 8). Where no point is the same,
/// lines that cross tell the place; if none do, `guess` tells it along them. Nothing without pairs. O(pairs).
std::optional<Alignment> align(std::span<const PlanePair> pairs, const Pose2& guess);

}  // namespace hallway::slam_plane::thesis
