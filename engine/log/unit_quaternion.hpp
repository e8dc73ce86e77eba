// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

namespace hallway::log {

/// Whether a quaternion read from a file has unit length but for rounding (within 0.01).
inline bool is_unit(const std::array<double, 4>& q) {
  constexpr double kTolerance = 0.01;
  return std::abs(std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])) - 1.0) <= kTolerance;
}

}  // namespace hallway::log
