// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bsp/enclosure.hpp"

namespace hallway::bsp {

/// Sides, the lesser first, of the narrowest rectangle with an edge along one of the polygons' edges that holds them all. They
/// lie in one plane.
std::pair<double, double> sides_of_rectangle(const std::vector<Polygon>& polygons);

/// Two portals of a convex cell, metres, and where a way passes each.
struct Passage {
  std::int32_t cell = 0;
  const Polygon& from;
  const Polygon& to;
  Vec3 from_at = Vec3::Zero();
  Vec3 to_at = Vec3::Zero();
};

/// The narrowest cut through a cell that has one portal on each side and solid along its long edges; empty if there is none. Portals lie in
/// planes of the tree, and between two edges that stand diagonally opposite there need not be one. O(portals + e v p) for e edges of the
/// two portals, v corners and p planes of the cell.
std::optional<Opening> narrowest_within(const CellSpace& space, const Passage& passage);

}  // namespace hallway::bsp
