// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "geometry/kd_tree.hpp"

namespace hallway::em {

/// The lengths from which defaults derive. Cloud's unit.
struct CloudScale {
  double spacing =
      0.0;             ///< side of the square of a surface that holds one point, middle of the cloud's points
  double noise = 0.0;  ///< standard deviation of the points across their surfaces
};

/// Looks at a few hundred neighbourhoods, spread evenly over the points in their order; all zero for fewer than 12 points. A
/// neighbourhood's noise is its scatter along its normal, at the size at which it is flattest; the flattest quarter
/// of the neighbourhoods counts, since the others lie at seams or hold outliers.
CloudScale measure_scale(std::span<const Vec3> points, const KdTree& tree);

}  // namespace hallway::em
