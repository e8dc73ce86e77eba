// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway {

/// A convex polygon in a plane, counter-clockwise, metres. Fewer than three corners: nothing.
using Convex = std::vector<Vec2>;

/// The third component of a x b: positive where b is to the left of a.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Two axes of a plane, as the x and y of a map that is looked at from where the normal points: u x v = normal. They follow from the normal alone.
struct PlaneAxes {
  /// @param normal  unit
  explicit PlaneAxes(const Vec3& normal);

  /// A point laid flat along the normal; points, and those that T moves here first.
  Vec2 flat(const Vec3& point) const { return {u.dot(point), v.dot(point)}; }
  Convex flat(std::span<const Vec3> points) const;
  Convex flat(std::span<const Vec3> points, const Pose& T) const;
  /// The point of the plane at that offset along its normal; the corners of a polygon.
  Vec3 lift(const Vec2& point, double offset) const { return point.x() * u + point.y() * v + offset * n; }
  std::vector<Vec3> lift(const Convex& polygon, double offset) const;

  Vec3 u, v, n;
};

/// The corners of the smallest convex polygon that holds the points, counter-clockwise from the one with the least (x, y); no three on
/// a line. Equal points give one, collinear ones two. Coordinates are finite. O(n log n).
Convex convex_hull(std::vector<Vec2> points);

/// Area within a polygon, positive for counter-clockwise ones; square metres.
double polygon_area(std::span<const Vec2> polygon);

/// The least distance between two parallel lines that hold the polygon between them, metres. O(n^2).
double width(const Convex& polygon);

/// What of a polygon lies where normal . x <= offset.
Convex clip(const Convex& polygon, const Vec2& normal, double offset);

}  // namespace hallway
