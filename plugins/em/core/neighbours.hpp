// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "em/core/slab_points.hpp"

namespace hallway::em {

/// A point near another.
struct NearPoint {
  double squared_distance = 0.0;
  std::uint32_t place = 0;  ///< in the list of points
};

/// Replaces `found` by the `most` points nearest to `p`, or all if there are fewer: nearest first, equal ones
/// by place. `radius` is a guess of how far that goes; a good one saves time.
void nearest(const PointField& field, const Vec3& p, std::size_t most, double radius,
             std::vector<NearPoint>& found);

}  // namespace hallway::em
