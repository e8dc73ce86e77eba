// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/kd_tree.hpp"
#include "icp/core/types.hpp"

namespace hallway::icp {

/// Median distance from a place to the nearest point of a tree that lies elsewhere [m]; 0 where there is none. O(places log n).
/// @param places  points of the tree, all or a sample
double spacing_of(const Points& places, const KdTree& tree);

/// How large a cloud is, whatever its outliers do: twice the median distance of its points from the median of their coordinates [m]. O(n).
double extent_of(const Points& points);

/// One point for each cube of edge `cube_m` that has any: the mean of those in it. In the order of the cubes; the same for every order of
/// the points. O(n log n).
/// @param points  usable ones
Points thinned(const Points& points, double cube_m);

/// `most` of the points, or all where there are fewer; which ones depends on their coordinates alone and not on their order. O(n log n).
/// @param points  usable ones
Points sampled(const Points& points, std::size_t most);

}  // namespace hallway::icp
