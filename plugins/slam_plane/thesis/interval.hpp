// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace hallway::slam_plane::thesis {

/// Number of a frame; grows by one a frame.
using Iteration = std::int64_t;

/// Iterations from `first` to `last`, both included; empty when last < first.
struct Interval {
  Iteration first = 0;
  Iteration last = -1;

  bool empty() const { return last < first; }
  Iteration size() const { return empty() ? 0 : last - first + 1; }
  bool contains(Iteration k) const { return first <= k && k <= last; }
  bool operator==(const Interval&) const = default;
};

/// What two intervals have in common; empty if nothing.
Interval intersection(const Interval& a, const Interval& b);

/// Disjoint intervals in the order of time.
using Intervals = std::vector<Interval>;

/// What two lists have in common. O(a + b).
Intervals intersection(const Intervals& a, const Intervals& b);

/// The longest one, the latest of several; empty if there is none.
Interval longest(const Intervals& intervals);

/// The interval of a list that contains k, or an empty one. O(log n).
Interval containing(const Intervals& intervals, Iteration k);

}  // namespace hallway::slam_plane::thesis
