// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "slam_plane/core/types.hpp"

namespace hallway::slam_plane {

/// Index of a wall or of a submap.
using Index = std::uint32_t;
inline constexpr Index kNone = 0xffffffffu;

/// A piece of the current frame with what is made of it, robot frame.
struct Sighting {
  Vec2 end[2];          ///< a and b [m]
  Vec2 middle;          ///< [m]
  Vec2 direction;       ///< unit, from a to b
  double length = 0.0;  ///< [m]
  double z_low = 0.0;
  double z_high = 0.0;
  std::size_t given = 0;            ///< which of the pieces given it is
  bool corner[2] = {false, false};  ///< judged to be a true corner, by this frame's geometry
  bool hidden[2] = {false, false};  ///< judged to be where something in front hides the rest
  Index wall = kNone;               ///< what it was taken for
  bool stray = false;               ///< it does not lie where its wall does
};

}  // namespace hallway::slam_plane
