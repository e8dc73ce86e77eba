// SPDX-License-Identifier: MIT
#pragma once

#include "icp/core/kd_tree.hpp"

namespace hallway::icp {

/// Median distance from a point to the nearest one that lies elsewhere [m]; 0 where there are not two places. O(n log n).
double spacing_of(const Points& points, const KdTree& tree);

/// How large a cloud is, whatever its outliers do: twice the median distance of its points from the median of their coordinates [m]. O(n).
double extent_of(const Points& points);

/// One point for each cube of edge `cube_m` that has any: the mean of those in it. In the order of the cubes; the same for every order of
/// the points. O(n log n).
/// @param points  usable ones
Points thinned(const Points& points, double cube_m);

}  // namespace hallway::icp
