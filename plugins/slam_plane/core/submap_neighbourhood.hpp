// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "slam_plane/core/wall_map.hpp"

namespace hallway::slam_plane {

/// Submaps that hang together by walls they share, nearest first, and the walls in them in that order.
struct SubmapNeighbourhood {
  std::vector<Index> submaps;
  std::vector<Index> walls;
};

/// The active submap, those that share a wall with it (the newest first), those that share one with these, and so on until there are `most`.
/// O(what is looked at), and some bits of the map.
SubmapNeighbourhood neighbourhood(const WallMap& map, std::size_t most);

/// The same of the whole map: what does not hang together with the active submap comes last. O(map).
SubmapNeighbourhood whole_map(const WallMap& map);

}  // namespace hallway::slam_plane
