// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geom/box.hpp"

namespace hallway::contact {

/// Sizes that a body may have, metres: its height, width and radius. No point of it is farther than the greatest from its origin.
inline constexpr double kLeastBodySize = 1e-3;
inline constexpr double kGreatestBodySize = 1e3;

/// A rigid convex body in its own frame, in metres: the origin is on the floor under it, x is forward, z up.
///
/// It is a polytope, or a cylinder about an axis that is parallel to the body's z axis. The cylinder is exact: its support is the circle's.
class BodyShape {
 public:
  /// The convex hull of points. Points inside of it do no harm.
  /// Throws Error{kBadInput} for points that are no numbers or beyond kGreatestBodySize, more than 1024 of them, and for a hull that is
  /// thinner than kLeastBodySize in some direction (fewer than four points, points of a plane).
  static BodyShape polytope(std::vector<Vec3> vertices);

  /// A box with sides along the body's axes.
  static BodyShape box(const Vec3& low, const Vec3& high);

  /// Throws Error{kBadInput} for sizes out of range.
  /// @param low, high  z of bottom and top
  /// @param axis       where the axis is in the body's x and y
  static BodyShape cylinder(double radius, double low, double high, const Vec2& axis = Vec2::Zero());

  /// The point of the body that is farthest along a direction, which need not have unit length; of several the first. O(vertices).
  Vec3 support(const Vec3& direction) const;

  /// How far the body reaches along a direction: max of direction . p over its points p.
  double extent(const Vec3& direction) const { return direction.dot(support(direction)); }

  /// The least box with sides along the world's axes that holds the body at a pose.
  Box box_at(const Pose& pose) const;

  /// Greatest distance of a point of the body from its origin.
  double radius() const { return radius_; }
  /// Lowest point, z in the body's frame.
  double bottom() const { return -extent(-Vec3::UnitZ()); }
  /// The vertices of a polytope; empty for a cylinder.
  const std::vector<Vec3>& vertices() const { return vertices_; }

 private:
  std::vector<Vec3> vertices_;  ///< empty: a cylinder
  Vec3 axis_ = Vec3::Zero();    ///< of a cylinder: the middle of its bottom
  double cylinder_radius_ = 0.0;
  double height_ = 0.0;
  double radius_ = 0.0;
};

}  // namespace hallway::contact
