// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace hallway {

/// A stretch of a line, from < to; may be infinite.
struct Interval {
  double from = 0.0;
  double to = 0.0;
};

/// Leaves of `kept` what is in none of `taken`. `kept` rises and does not overlap, before and after; `taken` may stand in any order,
/// overlap, and be empty or the wrong way round (which takes nothing); it is sorted. O(k + t log t) where they do not overlap much.
void subtract(std::vector<Interval>& kept, std::vector<Interval>& taken);

/// Leaves of an interval where g >= 0, for g linear with g(0) = `at_zero` and slope `slope`; empty (from >= to) if that is nowhere.
void keep_where_positive(Interval& interval, double at_zero, double slope);

}  // namespace hallway
