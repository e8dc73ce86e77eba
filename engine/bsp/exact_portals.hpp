// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bsp/exact_tree.hpp"
#include "geom/facet.hpp"

namespace hallway::bsp {

/// What two neighbouring regions share; map units.
struct ExactPortal {
  Facet facet;
  /// The regions in front of the facet's plane and behind it; kBeyond at the rim of what was divided.
  std::array<std::int32_t, 2> region{};

  static constexpr std::int32_t kBeyond = -1;
};

/// The portals between all cells of a tree and, at the rim, with what lies beyond. `rim` are the planes of a convex region that holds everything,
/// normals outward. Region numbers are those of cells. O(n log n) for a tree that is balanced.
std::vector<ExactPortal> cell_portals(PlaneSet& planes, const ExactTree& tree,
                                      const std::vector<OrientedPlane>& rim, double reach);

/// The portals between the leaves of one cell. Region numbers are those of leaves.
std::vector<ExactPortal> leaf_portals(PlaneSet& planes, const ExactTree& tree, const Cell& cell,
                                      const std::vector<OrientedPlane>& rim, double reach);

}  // namespace hallway::bsp
