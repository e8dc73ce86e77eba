// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "geometry/se3.hpp"

namespace hallway::sense {

/// The robot's body as its own sensors see it: an upright prism over a convex outline, or an upright cylinder about an axis. Body frame, metres.
struct OwnBody {
  std::vector<Vec2> corners{};  ///< of a prism, counter-clockwise; empty: a cylinder
  Vec2 middle = Vec2::Zero();   ///< of a cylinder
  double radius_m = 0.0;        ///< of a cylinder
  double bottom_m = 0.0;
  double top_m = 0.0;

  /// Whether a point is in the body or on its surface.
  bool contains(const Vec3& point) const;
  /// The distance at which a ray enters the body; infinite where it does not, and for a ray that starts in the body: a sensor sees out of its own housing.
  /// @param direction  of unit length
  double entry_m(const Vec3& origin, const Vec3& direction) const;
};

}  // namespace hallway::sense
