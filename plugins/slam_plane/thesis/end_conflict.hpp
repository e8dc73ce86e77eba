// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/thesis/comparison.hpp"

namespace hallway::slam_plane::thesis {

/// Two comparisons of the same ends of two planes that tell different offsets: one of them took an end for a corner that is none.
struct EndConflict {
  bool any = false;  ///< they differ by more than their standard deviations explain
  int which = 0;     ///< plane a (0) or b (1), whose end it is
  bool newer_right =
      false;  ///< in the newer one the plane reaches farther. It cannot be seen where it is not, so the other one is wrong (Rule 18: the largest size counts)
};

/// Compares two comparisons with key points of the same ends. O(1).
EndConflict conflict_between(const Comparison& older, const Comparison& newer);

}  // namespace hallway::slam_plane::thesis
