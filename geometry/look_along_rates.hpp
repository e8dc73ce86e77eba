// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/se3.hpp"

namespace hallway {

/// How the orientation of look_along() changes along a curve: by the curve's parameter, in the frame's own axes.
struct LookingRates {
  Vec3 rate = Vec3::Zero();   ///< rotation vector per unit of the parameter
  Vec3 slope = Vec3::Zero();  ///< its derivative
};

/// @param forward  unit, not vertical
/// @param first, second  its derivatives by the parameter
LookingRates look_along_rates(const Vec3& forward, const Vec3& first, const Vec3& second);

}  // namespace hallway
