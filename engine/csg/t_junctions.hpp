// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::csg {

/// Makes every vertex that lies within `distance` of an edge of a loop a vertex of that loop, and removes what then has no area: vertices
/// that follow themselves and edges that run there and back. Loops of which nothing is left become empty.
///
/// @param loops  closed loops of indices into `points`
/// O(n log n) for evenly spread points.
void resolve_t_junctions(const std::vector<Vec3>& points, double distance,
                         std::vector<std::vector<std::uint32_t>>& loops);

}  // namespace hallway::csg
