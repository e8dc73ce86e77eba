// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/thesis/track.hpp"

namespace hallway::slam_plane::thesis {

/// Calls `visit(sighting of a, sighting of b)` for each iteration of an interval in which both were seen, in the order of time: planes are never compared across
/// iterations (Rule 2). O(log n + sightings of both in the interval).
template <typename Visit>
void for_each_shared(const Track& a, const Track& b, const Interval& interval, const Visit& visit) {
  std::size_t i = a.lower_bound(interval.first);
  std::size_t j = b.lower_bound(interval.first);
  while (i < a.size() && j < b.size()) {
    const Sighting& in_a = a[i];
    const Sighting& in_b = b[j];
    if (in_a.iteration > interval.last || in_b.iteration > interval.last) return;
    if (in_a.iteration == in_b.iteration) visit(in_a, in_b);
    if (in_a.iteration <= in_b.iteration) ++i;
    if (in_b.iteration <= in_a.iteration) ++j;
  }
}

}  // namespace hallway::slam_plane::thesis
