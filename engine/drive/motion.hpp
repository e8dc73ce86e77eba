// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "geometry/planar_motion.hpp"

namespace hallway::drive {

/// A command is the twist that is wanted.
using Command = PlanarTwist;

/// Nanoseconds as seconds.
constexpr double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

/// The number at `part` of `whole` on the line from `from` to `to`; exactly `to` at the end, and where `whole` is 0.
inline double between(double from, double to, std::int64_t part, std::int64_t whole) {
  if (part == whole) return to;
  return from + (to - from) * (static_cast<double>(part) / static_cast<double>(whole));
}

}  // namespace hallway::drive
