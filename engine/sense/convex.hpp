// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry/se3.hpp"

namespace hallway::sense {

/// A convex polygon in a plane, counter-clockwise, metres. Fewer than three points: nothing.
using Convex = std::vector<Vec2>;

/// Area, square metres.
double area_of(const Convex& polygon);

/// The least distance between two parallel lines that hold the polygon between them, metres. O(n^2).
double width_of(const Convex& polygon);

/// The convex hull, without points that stand out of it by less than `tolerance_m`. O(n log n + n m).
Convex hull_of(std::vector<Vec2> points, double tolerance_m);

/// What of a polygon lies where normal . x <= offset.
Convex cut(const Convex& polygon, const Vec2& normal, double offset);

/// Takes from the pieces what `hole` covers. Pieces that it does not reach stay as they are.
void subtract(std::vector<Convex>& pieces, const Convex& hole);

}  // namespace hallway::sense
