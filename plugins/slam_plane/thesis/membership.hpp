// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "slam_plane/thesis/comparison.hpp"
#include "slam_plane/thesis/options.hpp"
#include "slam_plane/thesis/plane_track.hpp"

namespace hallway::slam_plane::thesis {

/// When all tracks were visible together (Rule 7). Of no track: nothing.
Intervals common_intervals(std::span<const PlaneTrack* const> members);

/// Whether a track can join: it was visible together with all members for some time, at least `min_interval` iterations (Rule 7).
bool fits(const Intervals& common, const PlaneTrack& candidate, int min_interval);

/// Which members link a submap to a new one that `newcomer` causes: up to `count` indices of members that were visible at a time with it, those first that came
/// into view last (Rule 9); of two that came together the one seen with it for longer. Fewer if there are fewer (Rule 8 wants two).
std::vector<int> linking_members(std::span<const PlaneTrack* const> members, const PlaneTrack& newcomer,
                                 int count);

/// What is to be thought of a member (Rules 31, 32).
enum class Membership {
  undecided,  ///< too early to tell
  confirmed,  ///< compared over enough iterations; need not be asked again
  too_short,  ///< should not be in this submap
};

/// Judges a member by the comparison that places it. `joined` and `now`: when it joined and the current iteration.
Membership judge_member(const Comparison& comparison, Iteration joined, Iteration now,
                        const Options& options);

}  // namespace hallway::slam_plane::thesis
