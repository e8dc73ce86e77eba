// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geom/polygon.hpp"

namespace hallway::bsp {

/// An opening between two clusters.
struct Portal {
  Polygon polygon;                         ///< metres; convex, strictly: no collinear vertices
  std::array<std::uint32_t, 2> cluster{};  ///< [0] lies in front of polygon.plane, [1] behind it
};

/// The clusters of a world and what connects them. Clusters that only touch solid have no portals.
struct PortalGraph {
  std::uint32_t clusters = 0;
  std::vector<Portal> portals;
};

}  // namespace hallway::bsp
