// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "slam_plane/core/types.hpp"

namespace hallway::slam_plane {

/// A time in which the robot's place along a direction could not be known. What was mapped since (epoch and later) hangs together, and so does
/// what was mapped before; how far they are displaced along the direction is known to `range_m` only.
struct Gap {
  std::uint32_t epoch = 0;        ///< of the walls and submaps that came after
  Vec2 direction = Vec2::Zero();  ///< unit, map frame
  double range_m = 0.0;           ///< bound of the displacement
};

}  // namespace hallway::slam_plane
