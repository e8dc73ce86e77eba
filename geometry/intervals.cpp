// SPDX-License-Identifier: MIT
#include "geometry/intervals.hpp"

#include <algorithm>
#include <utility>

namespace hallway {

void subtract(std::vector<Interval>& kept, std::vector<Interval>& taken) {
  std::erase_if(taken, [](const Interval& interval) { return !(interval.from < interval.to); });
  std::sort(taken.begin(), taken.end(), [](const Interval& a, const Interval& b) { return a.from < b.from; });
  std::vector<Interval> left;
  auto first = taken.begin();  // those before it end before the interval that is looked at
  for (const Interval& interval : kept) {
    double from = interval.from;
    while (first != taken.end() && first->to <= from) ++first;
    for (auto hidden = first; hidden != taken.end() && hidden->from < interval.to; ++hidden) {
      if (hidden->to <= from) continue;
      if (hidden->from > from) left.push_back({from, hidden->from});
      from = hidden->to;
    }
    if (from < interval.to) left.push_back({from, interval.to});
  }
  kept = std::move(left);
}

void keep_where_positive(Interval& interval, double at_zero, double slope) {
  if (slope > 0.0) {
    interval.from = std::max(interval.from, -at_zero / slope);
  } else if (slope < 0.0) {
    interval.to = std::min(interval.to, -at_zero / slope);
  } else if (at_zero < 0.0) {
    interval.to = interval.from;
  }
}

}  // namespace hallway
