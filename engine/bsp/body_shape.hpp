// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "bsp/body.hpp"

namespace hallway::bsp {

/// A body made ready for computing: the sum of a ball, a level disc, a level rectangle and an upright segment, most of them points.
struct BodyShape {
  double ball_m = 0.0;
  double disc_m = 0.0;
  Vec3 half_length = Vec3::Zero();  ///< half sides of the rectangle as vectors, metres
  Vec3 half_width = Vec3::Zero();
  double z_low_m = 0.0;
  double z_high_m = 0.0;

  /// The greatest d . x of its points x, relative to its position.
  double reach(const Vec3& d) const {
    return ball_m * d.norm() + disc_m * std::sqrt(d.x() * d.x() + d.y() * d.y()) +
           std::abs(half_length.dot(d)) + std::abs(half_width.dot(d)) +
           (d.z() < 0.0 ? d.z() * z_low_m : d.z() * z_high_m);
  }

  /// Its middle, relative to its position.
  Vec3 middle() const { return {0.0, 0.0, 0.5 * (z_low_m + z_high_m)}; }
};

/// The shape of a body whose sides, top and bottom lie `margin` metres farther out.
BodyShape shape_of(const Body& body, double margin);

}  // namespace hallway::bsp
