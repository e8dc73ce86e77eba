// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/se3.hpp"

namespace hallway {

/// The plane of points x with normal . x = offset; `normal` has unit length and points outward where the plane bounds a
/// solid. Metres.
struct Plane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0.0;

  /// Signed distance of a point, positive on the side that the normal points to.
  double distance(const Vec3& point) const { return normal.dot(point) - offset; }
};

}  // namespace hallway
