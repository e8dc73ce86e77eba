// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_plane/spatial/face_map.hpp"

namespace hallway::slam_plane::spatial {

/// Lays submaps where all of them agree best: Gauss-Newton steps over the sum of all evidence with the planes and the lines of certain edges eliminated,
/// edges that are far off counting less. Submaps that are not named stay.
/// @param free   submaps that may move; without the first one, which holds the map's frame
/// @param steps  at most; one that does not lower the sum is taken back and is the last
/// Returns the number of steps taken. Faces are estimated anew. O(features * submaps that saw them ^2 + free ^3) a step.
int solve(FaceMap& map, const std::vector<Index>& free, int steps);

}  // namespace hallway::slam_plane::spatial
