// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "em/core/cells.hpp"
#include "em/core/growth.hpp"
#include "em/core/moments.hpp"

namespace hallway::em {

/// The log density of cells that a patch does not cover.
inline constexpr float kNotCovered = -1e30f;
/// Cells of a grid at most; where there would be more they are made larger.
inline constexpr std::size_t kMostCells = std::size_t{1} << 24;

/// A finite plane as a component of the mixture.
struct Patch {
  PlaneFrame frame;
  double sigma = 0.0;          ///< noise across it
  double level = 0.0;          ///< noise that it was found with; its own stays near
  double density = 0.0;        ///< points per area
  CellGrid grid;               ///< in the frame's coordinates
  CellMap<float> log_density;  ///< log of points per area of each cell, or kNotCovered

  /// Whether a cell that the patch covers holds a place of its plane.
  bool covers(const Vec2& at) const {
    return grid.contains(at) && log_density[grid.at(at.x(), at.y())] != kNotCovered;
  }
};

/// Log of the normal density of noise `sigma` at its peak.
double log_peak(double sigma);

/// What lies within so many standard deviations of the patch, over its grid.
Slab slab_over(const Patch& patch, double sigmas);

/// The patch that covers what grew and a little beyond, at its mean density.
Patch patch_of(const Grown& grown);

/// The patch on the same plane that covers the cells of `grid` marked in `cells` and a little beyond, at
/// density `density`.
Patch restricted(const Patch& patch, const CellGrid& grid, const CellMap<std::uint8_t>& cells,
                 double density);

/// Whether the middle of a cell of `right` lies over a cell of `left`, seen along the normal of `left`.
bool touching(const Patch& left, const Patch& right);

/// The patch on the plane of `frame` that covers both, at the greater density.
Patch joined(const Patch& left, const Patch& right, const PlaneFrame& frame);

/// The patch for a cloud with `factor` times as many points.
Patch denser(const Patch& patch, double factor);

/// Keeps a range of the cells of the grid; not an empty one.
void crop(Patch& patch, const CellRange& range);

/// Calls visit(middle) with the place in space of each cell that the patch covers.
template <typename Visit>
void visit_cells(const Patch& patch, Visit visit) {
  for (int row = 0; row < patch.grid.rows; ++row) {
    for (int column = 0; column < patch.grid.columns; ++column) {
      if (patch.log_density[patch.grid.place(column, row)] != kNotCovered)
        visit(patch.frame.lift(patch.grid.middle(column, row)));
    }
  }
}

}  // namespace hallway::em
