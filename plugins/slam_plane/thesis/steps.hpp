// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "slam_plane/thesis/options.hpp"
#include "slam_plane/thesis/state.hpp"

/// The steps of an iteration that work on the whole state; ThesisMapper takes them in their order.
namespace hallway::slam_plane::thesis {

/// Adds the observations of an iteration to the tracks (thesis 4.5 AddPlane): to those of the current submap first, then to those of submaps linked to it, then to others
/// seen just before (Rule 1). What is left begins new tracks. Fills matches, seen and chart.
void add_planes(std::span<const WallObservation> given, const Options& options, State& state);

/// Counts for each submap the tracks in view that are members of it, or were mapped twice and only count (Rules 22, 37). O(submaps of what is seen).
void chart_submaps(State& state);

/// Looks for the unassigned tracks of the last iteration in the map, where that iteration's pose puts them (Rule 11). Those found go on as the mapped track.
void match_with_map(const Options& options, State& state);

/// All mapped tracks that a segment of the map's frame may be, the best first.
std::vector<TrackId> map_matches(const Segment& segment, const Options& options, const State& state);

/// Gives tracks that were seen often enough to submaps, or begins submaps with them, and says which submap is the current one (thesis 4.5
/// ManageXPoints; Rules 7, 8, 9, 12, 21, 22, 29, 37).
void manage_submaps(const Options& options, State& state);

/// Aligns the first submap to the planes of the first iteration, in whose robot frame the map is: notes which ends were static then (Rule 4).
void anchor_first(State& state);

/// Fixes submaps of State::unanchored where the robot's pose of now puts them: those that a motion model began (Rules 27, 29), and those that lost their link to older ones while
/// the map tells the pose. @returns how many.
std::uint64_t anchor_by_pose(const Alignment& location, State& state);

/// For how many iterations a track that is not in the map is kept out of view: longer than a roll back reaches.
int forget_after(const Options& options);

/// Forgets what came to nothing for longer than a roll back reaches (a rule of ours; the thesis keeps all). Every 20 iterations it looks for submaps that were not the current one for so long and have
/// of their own only tracks that are not in the map and were not seen for so long; unless one of them alone tells an end of a wall of the map it is emptied, those linked to it are linked to what it was
/// made from, and of its own tracks those that no other submap has are forgotten with their pairs. Its place in the list stays taken until close_up. Tracks that have neither an observation nor a submap are released. O(tracks + submaps * members).
void prune_stale(const Options& options, State& state);

/// Closes up the list of submaps where most of it are empty ones. @returns for each index of before the one of now, kNoSubmap for a submap that is no more; nothing if no index changed.
/// Amortized O(members) a submap that was emptied.
std::vector<SubmapIndex> close_up(State& state);

}  // namespace hallway::slam_plane::thesis
