// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/interval.hpp"

#include <algorithm>

namespace hallway::slam_plane::thesis {

Interval intersection(const Interval& a, const Interval& b) {
  const Interval both{std::max(a.first, b.first), std::min(a.last, b.last)};
  return both.empty() ? Interval{} : both;
}

Intervals intersection(const Intervals& a, const Intervals& b) {
  Intervals result;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const Interval both = intersection(a[i], b[j]);
    if (!both.empty()) result.push_back(both);
    if (a[i].last < b[j].last) {
      ++i;
    } else {
      ++j;
    }
  }
  return result;
}

Interval longest(const Intervals& intervals) {
  Interval best;
  for (const Interval& interval : intervals) {
    if (interval.size() >= best.size()) best = interval;
  }
  return best;
}

Interval containing(const Intervals& intervals, Iteration k) {
  const auto after = std::ranges::upper_bound(intervals, k, {}, &Interval::first);
  if (after == intervals.begin() || !(after - 1)->contains(k)) return {};
  return *(after - 1);
}

}  // namespace hallway::slam_plane::thesis
