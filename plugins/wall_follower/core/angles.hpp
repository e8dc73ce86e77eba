// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

#include "geometry/se3.hpp"

namespace hallway::wall_follower {

inline constexpr double kQuarter = std::numbers::pi / 2.0;  ///< a turn of 90 degrees [rad]

inline double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

/// An angle in (-pi, pi] [rad].
inline double wrapped(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

/// Unit vector of a direction [rad].
inline Vec2 unit(double direction) {
  return {std::cos(direction), std::sin(direction)};
}

/// A vector turned by an angle to the left [rad].
inline Vec2 turned(const Vec2& v, double angle) {
  const Vec2 u = unit(angle);
  return {u.x() * v.x() - u.y() * v.y(), u.y() * v.x() + u.x() * v.y()};
}

}  // namespace hallway::wall_follower
