// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "em/core/types.hpp"
#include "geometry/convex2.hpp"

namespace hallway::em {

/// The normal's direction that points from the plane towards the origin, from where a sensor sees it; of a plane through the
/// origin, the one whose first component that is not zero is positive. So normal . x <= 0 on the plane.
Vec3 orient(const Vec3& normal, const Vec3& on_plane);

/// A frame on the plane through `origin`; its axes are a function of the unit normal alone.
PlaneFrame flat_frame(const Vec3& normal, const Vec3& origin);

/// A rectangle at any angle.
struct Rectangle {
  Vec2 centre = Vec2::Zero();
  Vec2 axis = Vec2::UnitX();  ///< unit, along the longer sides
  double half_u = 0.0;        ///< half length along `axis`
  double half_v = 0.0;        ///< half length along the axis turned by +90 degrees

  Vec2 side() const { return {-axis.y(), axis.x()}; }
  double area() const { return 4.0 * half_u * half_v; }
  /// Whether the point lies within the rectangle or no farther than `margin` beyond one of its sides.
  bool contains(const Vec2& p, double margin = 0.0) const;
  /// Counter-clockwise.
  std::array<Vec2, 4> corners() const;
};

/// The rectangle of least area that holds a hull as convex_hull() makes it; one of its sides lies along an edge of the hull, the first one
/// where several are as good. Rotating calipers (Toussaint 1983), O(corners).
Rectangle tightest_rectangle(std::span<const Vec2> hull);

/// What points cover on a plane.
struct Outline {
  PlaneFrame frame;
  std::vector<Vec2> hull;
  Rectangle rectangle;
};

/// The outline of points' feet on the plane through `origin`; empty points give an outline of no extent at the origin.
Outline outline_of(std::span<const Vec3> points, const Vec3& normal, const Vec3& origin);

/// The corners in space, counter-clockwise seen from where the frame's u x v points.
std::array<Vec3, 4> corners_of(const Outline& outline);
std::vector<Vec3> hull_of(const Outline& outline);

/// What points show of a plane.
struct Footprint {
  Vec3 centroid = Vec3::Zero();  ///< the foot of their mean
  double rms = 0.0;              ///< distance of the points from the plane
  Outline outline;
};

/// The footprint of points, at least one, on the plane through `origin`.
Footprint footprint_of(std::span<const Vec3> points, const Vec3& normal, const Vec3& origin);

/// Points per area; 0 where there is no area.
double density(double points, double area);

}  // namespace hallway::em
