// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "icp/core/types.hpp"

namespace hallway::icp {

/// One matched pair: `target` ~ T * source, and `moved` is T * source.
struct Pair {
  Vec3 target = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< of the surface at `target`, of unit length; for fit_planes() alone
  Vec3 moved = Vec3::Zero();
  double weight = 1.0;  ///< at least 0
};

/// The motion that brings the moved points nearest to their targets: the least weighted sum of squared distances, by the singular value
/// decomposition of their moments (Arun, Huang and Blostein 1987; thesis 3.2.2, steps 5 and 7). None where points on a line, at one
/// place or without weight leave it open. O(n).
std::optional<Pose> fit_points(const std::vector<Pair>& pairs);

/// The motion that brings the moved points nearest to the planes through their targets: one Gauss-Newton step (Chen and Medioni 1991). None
/// where the planes leave it open, as those of a plain corridor do along it. O(n).
std::optional<Pose> fit_planes(const std::vector<Pair>& pairs);

}  // namespace hallway::icp
