// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::em {

/// A frame on a plane: coordinates (a, b) along `u` and `v` from `origin`, height along `normal`.
/// Orthonormal, right-handed (u x v = normal).
struct PlaneFrame {
  Vec3 origin = Vec3::Zero();
  Vec3 u = Vec3::UnitX();
  Vec3 v = Vec3::UnitY();
  Vec3 normal = Vec3::UnitZ();

  /// A point's foot on the plane, and how high the point is above it.
  Vec2 flat(const Vec3& p) const { return {u.dot(p - origin), v.dot(p - origin)}; }
  double height(const Vec3& p) const { return normal.dot(p - origin); }
  /// Where a place of the plane lies in space.
  Vec3 lift(const Vec2& p) const { return origin + p.x() * u + p.y() * v; }
};

/// Index of a point of the cloud, in the order given.
using PointIndex = std::uint32_t;

/// What no plane claims.
inline constexpr std::uint32_t kNoPlane = 0xffffffffu;

/// A finite plane and the points that it explains. Cloud's frame, the cloud's own unit of length.
struct Plane {
  std::uint64_t id =
      0;  ///< the same in the next frame where planes are kept across frames (PlaneMemory); else its place in the list
  Vec3 normal = Vec3::UnitZ();   ///< unit, towards the origin of the cloud's frame (the sensor); see orient()
  double offset = 0.0;           ///< normal . x = offset on the plane; <= 0 by the choice of the normal
  Vec3 centroid = Vec3::Zero();  ///< of the member points, on the plane
  std::array<Vec3, 4> corners{};    ///< tight rectangle, counter-clockwise seen from where the normal points
  std::vector<Vec3> hull;           ///< convex hull of the members on the plane, counter-clockwise likewise
  std::vector<PointIndex> members;  ///< ascending; a point at a seam may be a member of two planes
  double rms = 0.0;                 ///< distance of the members from the plane
  double exclusive_share =
      1.0;  ///< of the points within its slab and extent, those that no other plane explains as well
};

/// What an extraction found.
struct Extraction {
  std::vector<Plane> planes;  ///< most members first
  std::vector<std::uint32_t>
      labels;  ///< for each point its plane's place in `planes`, or kNoPlane; of two planes the likelier one
  double noise =
      0.0;  ///< standard deviation of the points across their planes, as estimated; 0 without planes
};

}  // namespace hallway::em
