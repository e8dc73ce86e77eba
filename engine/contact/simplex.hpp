// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "geometry/se3.hpp"

namespace hallway::contact {

/// A point of the difference of two bodies, and the points that it comes from.
struct DifferencePoint {
  Vec3 at = Vec3::Zero();  ///< first - second
  Vec3 first = Vec3::Zero();
  Vec3 second = Vec3::Zero();
};

/// The point of a triangle that is nearest to the origin; the triangle may be without area.
struct NearestOfTriangle {
  Vec3 point = Vec3::Zero();
  std::array<double, 3> weights{};  ///< of the corners; zero for those that do not carry the point
};
NearestOfTriangle nearest_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c);

/// Up to four points of a difference, and the point of their hull that is nearest to the origin: the state of the algorithm of Gilbert, Johnson and
/// Keerthi ("A fast procedure for computing the distance between complex objects", 1988).
class Simplex {
 public:
  explicit Simplex(const DifferencePoint& point);

  /// Adds a point, finds the nearest point of the hull and drops the points that do not carry it. Edges and triangles are searched one
  /// by one, so that points on a line or in a plane do no harm. At most three points are left, or four around the origin.
  void add(const DifferencePoint& point);

  /// The point of the hull that is nearest to the origin.
  const Vec3& nearest() const { return nearest_; }
  /// True if the origin is in the hull of four points.
  bool holds_origin() const { return holds_origin_; }
  bool has(const DifferencePoint& point) const;
  /// Where the nearest point is on the first and on the second body.
  Vec3 on_first() const;
  Vec3 on_second() const;
  /// The direction of nearest(), unit, computed from the edge or the triangle that it is on: this keeps its precision where the hull
  /// passes the origin closely. Zero where there is none.
  Vec3 direction() const;

 private:
  struct Found;
  Found on_segment(std::size_t a, std::size_t b) const;
  Found on_triangle(std::size_t a, std::size_t b, std::size_t c) const;
  Found nearest_of_four() const;
  void take(const Found& found);

  std::array<DifferencePoint, 4> points_;
  std::array<double, 4> weights_{1.0, 0.0, 0.0, 0.0};
  std::size_t count_ = 1;
  Vec3 nearest_;
  bool holds_origin_ = false;
};

}  // namespace hallway::contact
