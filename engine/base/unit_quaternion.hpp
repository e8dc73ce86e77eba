// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace hallway {

/// How far from 1 the length of a unit quaternion or normal may be that a program hands over as numbers: a few roundings.
inline constexpr double kUnitTolerance = 1e-6;
/// The same for one that was read from a file, whose writer may have cut its decimals.
inline constexpr double kUnitFileTolerance = 0.01;

/// The length of a quaternion, its numbers in any order. Not finite where one of them is not.
inline double quaternion_length(std::span<const double, 4> q) {
  double squared = 0;
  for (const double number : q) squared += number * number;
  return std::sqrt(squared);
}

/// Whether it is a rotation: its length is 1 but for `tolerance`.
inline bool is_unit_quaternion(std::span<const double, 4> q, double tolerance = kUnitTolerance) {
  return std::abs(quaternion_length(q) - 1.0) <= tolerance;
}

/// Whether a position [m] and an orientation are a pose: finite, and a rotation within kUnitTolerance.
inline bool is_pose(std::span<const double, 3> position, std::span<const double, 4> orientation) {
  return std::ranges::all_of(position, [](double x) { return std::isfinite(x); }) &&
         is_unit_quaternion(orientation);
}

}  // namespace hallway
