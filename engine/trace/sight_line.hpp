// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "geometry/se3.hpp"

namespace hallway::trace {

/// A checked ray: finite numbers, a direction of unit length, a distance that is not negative (it may be
/// infinite).
struct SightLine {
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();
  double max_distance = 0.0;
};

/// The ray's line for finite numbers; empty for a ray that by its definition hits nothing.
std::optional<SightLine> sight_line(const Vec3& origin, const Vec3& direction, double max_distance);

/// The line between two finite points, the same for (a, b) and (b, a); empty if they are one.
std::optional<SightLine> sight_line_between(const Vec3& one, const Vec3& other);

}  // namespace hallway::trace
