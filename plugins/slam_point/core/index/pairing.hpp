// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>

namespace hallway::slam_point {

/// A point and something that it may be associated with. Pairings sort by distance, equal ones by numbers: who takes them in that order, one to one,
/// associates the nearest first, whatever the order of points.
struct Pairing {
  double d2 = 0.0;  ///< squared distance [m^2]
  std::uint32_t point = 0;
  std::uint32_t other = 0;

  auto operator<=>(const Pairing&) const = default;
};

}  // namespace hallway::slam_point
