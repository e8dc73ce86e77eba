// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "slam_plane/spatial/types.hpp"

namespace hallway::slam_plane::spatial {

/// A convex polygon, counter-clockwise [m].
using Polygon = std::vector<Vec2>;

/// Two axes of a plane, and its normal: right-handed.
struct PlaneAxes {
  explicit PlaneAxes(const Vec3& normal);

  Vec2 flat(const Vec3& p) const { return {u.dot(p), v.dot(p)}; }
  /// The point of the plane at that offset along its normal.
  Vec3 lift(const Vec2& p, double offset) const { return p.x() * u + p.y() * v + offset * n; }

  Vec3 u, v, n;
};

/// Area of a polygon [m^2].
double area(const Polygon& polygon);

/// The least distance between two parallel lines that a convex polygon lies between [m]. O(n^2).
double width(const Polygon& polygon);

/// The convex hull of points; less than three where they lie on a line. O(n log n).
Polygon convex_hull(std::vector<Vec2> points);

/// What of a polygon lies where normal . x <= offset.
Polygon clip(const Polygon& polygon, const Vec2& normal, double offset);

/// Area that two polygons share [m^2]. O(n m).
double overlap_area(const Polygon& a, const Polygon& b);

/// How far two polygons are from each other at their nearest points; 0 if they overlap [m]. O(n m).
double distance(const Polygon& a, const Polygon& b);

/// Takes away the corners that matter least until `most` are left.
void simplify(Polygon& polygon, std::size_t most);

/// Points laid flat along a plane's normal.
std::vector<Vec2> flattened(std::span<const Vec3> points, const PlaneAxes& axes);

}  // namespace hallway::slam_plane::spatial
