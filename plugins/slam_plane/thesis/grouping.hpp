// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/thesis/state.hpp"

namespace hallway::slam_plane::thesis {

/// Gives tracks that were seen often enough to submaps, or begins submaps with them, and says which submap is the current one (thesis 4.5
/// ManageXPoints; Rules 7, 8, 9, 12, 21, 22, 29, 37).
void manage_submaps(const Options& options, State& state);

}  // namespace hallway::slam_plane::thesis
