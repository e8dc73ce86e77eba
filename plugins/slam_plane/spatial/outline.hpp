// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geometry/convex2.hpp"
#include "slam_plane/spatial/types.hpp"

namespace hallway::slam_plane::spatial {

/// Appends points that T moves.
void append_moved(const Pose& T, std::span<const Vec3> from, std::vector<Vec3>& to);

/// Area of a polygon, whichever way round [m^2].
double area(const Convex& polygon);

/// Area that two polygons share [m^2]. O(n m).
double overlap_area(const Convex& a, const Convex& b);

/// How far two polygons are from each other at their nearest points; 0 if they overlap [m]. O(n m).
double distance(const Convex& a, const Convex& b);

/// Takes away the corners that matter least until `most` are left.
void simplify(Convex& polygon, std::size_t most);

}  // namespace hallway::slam_plane::spatial
