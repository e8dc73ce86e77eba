// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geom/plane.hpp"

namespace hallway {

/// A convex planar polygon; its vertices run counter-clockwise when seen from the side that the plane's normal points to.
struct Polygon {
  std::vector<Vec3> vertices;  ///< at least three, metres
  Plane plane;
};

}  // namespace hallway
