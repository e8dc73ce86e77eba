// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_plane/thesis/state.hpp"

namespace hallway::slam_plane::thesis {

/// For how many iterations a track that is not in the map is kept out of view: longer than a roll back reaches.
int forget_after(const Options& options);

/// Forgets what came to nothing for longer than a roll back reaches (a rule of ours; the thesis keeps all). Every 20 iterations it looks for submaps that were not the current one for so long and have
/// of their own only tracks that are not in the map and were not seen for so long; unless one of them alone tells an end of a wall of the map it is emptied, those linked to it are linked to what it was
/// made from, and of its own tracks those that no other submap has are forgotten with their pairs. Its place in the list stays taken until close_up. Tracks that have neither a sighting nor a submap are released. O(tracks + submaps * members).
void forget_vain(const Options& options, State& state);

/// Closes up the list of submaps where most of it are empty ones. @returns for each index of before the one of now, kNoSubmap for a submap that is no more; nothing if no index changed.
/// Amortized O(members) a submap that was emptied.
std::vector<SubmapIndex> close_up(State& state);

}  // namespace hallway::slam_plane::thesis
