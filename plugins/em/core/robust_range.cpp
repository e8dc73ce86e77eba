// SPDX-License-Identifier: MIT
#include "em/core/robust_range.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hallway::em {
namespace {

constexpr int kRangeBins = 256;   // of the histogram that finds the range of nearly all points
constexpr int kRangeRounds = 40;  // each narrows at least fourfold: enough for coordinates of 1e24 ranges
constexpr std::size_t kStraysDivisor = 200;  // at each end of each axis one point in so many may lie outside

struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// The part of `range` that holds all but one in kStraysDivisor values at each end, in whole bins.
Range narrowed(const std::vector<Vec3>& cloud, int axis, const Range& range) {
  std::array<std::size_t, kRangeBins> counts{};
  const double scale = kRangeBins / (range.high - range.low);
  std::size_t below = 0;
  std::size_t above = 0;
  for (const Vec3& p : cloud) {
    const double value = p[axis];
    if (value < range.low) {
      ++below;
    } else if (value > range.high) {
      ++above;
    } else {
      ++counts[static_cast<std::size_t>(std::min((value - range.low) * scale, kRangeBins - 1.0))];
    }
  }
  const std::size_t strays = cloud.size() / kStraysDivisor;
  std::size_t first = 0;
  std::size_t last = kRangeBins - 1;
  while (first < last && below + counts[first] <= strays) below += counts[first++];
  while (last > first && above + counts[last] <= strays) above += counts[last--];
  return {range.low + static_cast<double>(first) / scale, range.low + static_cast<double>(last + 1) / scale};
}

/// The range of nearly all points along an axis: that of all, unless a few strays far away would make it
/// more than four times as long, for the Morton cells would be too coarse then.
Range robust_range(const std::vector<Vec3>& cloud, int axis) {
  Range range{cloud.front()[axis], cloud.front()[axis]};
  for (const Vec3& p : cloud) {
    range.low = std::min(range.low, p[axis]);
    range.high = std::max(range.high, p[axis]);
  }
  for (int round = 0; round < kRangeRounds; ++round) {
    const double length = range.high - range.low;
    const double finest = 1e-12 * std::max(std::abs(range.low), std::abs(range.high));
    if (length <= finest) break;
    const Range next = narrowed(cloud, axis, range);
    if (next.high - next.low > 0.25 * length) break;
    range = next;
  }
  return range;
}

}  // namespace

Bounds robust_bounds(const std::vector<Vec3>& cloud) {
  Bounds bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const Range range = robust_range(cloud, axis);
    bounds.low[axis] = range.low;
    bounds.high[axis] = range.high;
  }
  return bounds;
}

}  // namespace hallway::em
