// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geom/facet.hpp"

namespace hallway::csg {

/// Joins facets of one plane that share a whole edge where the union is convex, until no two do. The facets must not overlap.
/// O(k log k) for each round of joining, k facets.
void merge_convex(const PlaneSet& planes, std::vector<Facet>& facets);

}  // namespace hallway::csg
