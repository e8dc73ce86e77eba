// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "em/core/types.hpp"

namespace hallway::em {

/// A cloud in an order that follows from its coordinates, so that no result depends on the order in which it was given. Points
/// with a coordinate that is not finite, or larger than 1e100, are left out; equal ones stand once.
struct SortedCloud {
  std::vector<Vec3> points;    ///< by x, y, z; relative to `origin`
  Vec3 origin = Vec3::Zero();  ///< middle value of each coordinate, in the cloud's frame
  std::vector<std::uint32_t>
      place_of;  ///< of each point given its place in `points`, or kNoPlane where it was left out
};

/// O(n log n).
SortedCloud sort_cloud(std::span<const Vec3> cloud);

}  // namespace hallway::em
