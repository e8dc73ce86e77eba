// SPDX-License-Identifier: MIT
#pragma once

#include "geom/pose.hpp"

namespace hallway::trace {

/// A checked ray: finite numbers, a direction of unit length, a distance that is not negative (it may be
/// infinite).
struct SightLine {
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();
  double max_distance = 0.0;
};

}  // namespace hallway::trace
