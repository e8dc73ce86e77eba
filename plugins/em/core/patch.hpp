// SPDX-License-Identifier: MIT
#pragma once

#include "em/core/cells.hpp"
#include "em/core/growth.hpp"
#include "em/core/moments.hpp"

namespace hallway::em {

/// A finite plane as a component of the mixture.
struct Patch {
  PlaneFrame frame;
  double sigma = 0.0;                ///< noise across it
  CellGrid grid;                     ///< in the frame's coordinates
  CellMap<float> log_density;        ///< log of points per area; kNotSupported where the plane is not
  double density = 0.0;              ///< points per area, median over its cells
};

/// The log density of cells that a patch does not cover.
inline constexpr float kNotSupported = -1e30f;

/// The patch that covers what grew, a cell beyond it, at its mean density.
Patch patch_of(const Grown& grown);

/// Whether a cell of one lies on or beside a cell of the other, as seen along the first one's normal.
bool touching(const Patch& left, const Patch& right);

/// The patch on the plane of `frame` that covers both, at their mean density.
Patch joined(const Patch& left, const Patch& right, const PlaneFrame& frame);

}  // namespace hallway::em
