// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "slam_plane/spatial/types.hpp"

namespace hallway::slam_plane::spatial {

/// Two axes of a plane, and its normal: right-handed.
struct PlaneAxes {
  explicit PlaneAxes(const Vec3& normal);

  Vec2 flat(const Vec3& p) const { return {u.dot(p), v.dot(p)}; }
  /// Points laid flat along the normal, and points that T moves here.
  Convex flat(std::span<const Vec3> points) const;
  Convex flat(std::span<const Vec3> points, const Pose& T) const;
  /// The point of the plane at that offset along its normal.
  Vec3 lift(const Vec2& p, double offset) const { return p.x() * u + p.y() * v + offset * n; }
  std::vector<Vec3> lift(const Convex& polygon, double offset) const;

  Vec3 u, v, n;
};

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
