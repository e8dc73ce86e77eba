// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry/se3.hpp"

namespace hallway::icp {

using Points = std::vector<Vec3>;

/// Coordinates beyond this are taken for faults [m]: they leave a double no digits for what is near.
inline constexpr double kMaxCoordinate_m = 1e9;

/// Whether a point can be used: it is finite, and no coordinate is beyond kMaxCoordinate_m.
inline bool usable(const Vec3& p) {
  return p.cwiseAbs().maxCoeff() <= kMaxCoordinate_m && p.allFinite();
}

/// The usable points of a cloud, in their order.
inline Points usable_points(const Points& points) {
  Points kept;
  kept.reserve(points.size());
  for (const Vec3& p : points) {
    if (usable(p)) kept.push_back(p);
  }
  return kept;
}

}  // namespace hallway::icp
