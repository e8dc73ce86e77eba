// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/size_filter.hpp"

#include <algorithm>

namespace hallway::slam_plane::thesis {

void LargestLengths::add(double length, Iteration iteration) {
  const auto before = [](const Entry& a, const Entry& b) {
    return a.length > b.length || (a.length == b.length && a.iteration < b.iteration);
  };
  Entry entry{length, iteration};
  for (int i = 0; i < count_; ++i) {
    Entry& kept = entries_[static_cast<std::size_t>(i)];
    if (before(entry, kept)) std::swap(entry, kept);
  }
  if (count_ < kKept) entries_[static_cast<std::size_t>(count_++)] = entry;
}

void LargestLengths::add(const LargestLengths& other) {
  for (int i = 0; i < other.count_; ++i) add(other[i].length, other[i].iteration);
}

int LargestLengths::outliers(int backing, double tolerance) const {
  const int needed = std::min(backing, count_);
  if (needed <= 1) return 0;
  const double backed = (*this)[needed - 1].length + tolerance;
  int outliers = 0;
  while (outliers < needed - 1 && (*this)[outliers].length > backed) ++outliers;
  return outliers;
}

}  // namespace hallway::slam_plane::thesis
