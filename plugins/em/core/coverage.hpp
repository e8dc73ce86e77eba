// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "em/core/cells.hpp"

namespace hallway::em {

/// Means of `values` over squares of 2 `radius` + 1 cells about each cell; outside of the grid there is
/// nothing. O(cells).
CellMap<float> mean_within(const CellGrid& grid, const CellMap<float>& values, int radius);

/// The cells that something covers most likely. `gain`: by how much the log likelihood of the points in a
/// cell grows where it is covered. Neighbours that differ are unlikely, so a cell follows those around it
/// unless its own points say otherwise (iterated conditional modes: Besag 1986). The outermost cells are
/// never covered: callers leave a margin.
CellMap<std::uint8_t> likely_covered(const CellGrid& grid, const CellMap<float>& gain);

}  // namespace hallway::em
