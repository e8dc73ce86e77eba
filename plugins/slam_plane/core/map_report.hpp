// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/core/wall_map.hpp"

namespace hallway::slam_plane {

/// The map as it is told. A wall is mapped from `min_observations` on. O(map).
Map told(const WallMap& map, int min_observations);

}  // namespace hallway::slam_plane
