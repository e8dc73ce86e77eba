// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "slam_plane/thesis/options.hpp"
#include "slam_plane/thesis/state.hpp"

namespace hallway::slam_plane::thesis {

/// Adds the pieces of an iteration to the tracks (thesis 4.5 AddPlane): to those of the current submap first, then to those of submaps linked to it, then to others
/// seen just before (Rule 1). What is left begins new tracks. Fills matches, seen and chart.
void add_planes(std::span<const Piece> pieces, const Options& options, State& state);

/// Counts for each submap the tracks in view that are members of it, or were mapped twice and only count (Rules 22, 37). O(submaps of what is seen).
void chart_submaps(State& state);

/// Looks for the unassigned tracks of the last iteration in the map, where that iteration's pose puts them (Rule 11). Those found go on as the mapped track.
void match_with_map(const Options& options, State& state);

/// All mapped tracks that a segment of the map's frame may be, the best first.
std::vector<TrackId> map_matches(const Segment& segment, const Options& options, const State& state);

}  // namespace hallway::slam_plane::thesis
