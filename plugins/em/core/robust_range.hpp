// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "em/core/types.hpp"
#include "em/core/workers.hpp"

namespace hallway::em {

/// Axis-parallel box.
struct Bounds {
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();

  bool contains(const Vec3& p) const {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  }
};

/// The box of all points; but where a few strays far away would make it more than four times as long along an
/// axis, of nearly all. The points are finite and at least one; their order does not matter. O(n).
Bounds robust_bounds(std::span<const Vec3> cloud, Workers& workers);

}  // namespace hallway::em
