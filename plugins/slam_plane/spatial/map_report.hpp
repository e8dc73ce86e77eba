// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/spatial/face_map.hpp"

namespace hallway::slam_plane::spatial {

/// The map as it is told: outlines end at certain edges where these are known, and else where the faces were seen up to. O(map).
/// @param min_observations  of a face that is mapped
Map report_map(const FaceMap& map, int min_observations);

}  // namespace hallway::slam_plane::spatial
