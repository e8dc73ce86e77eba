// SPDX-License-Identifier: MIT
#include "em/core/robust_range.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace hallway::em {
namespace {

constexpr int kRangeBins = 256;   // of the histogram that finds the range of nearly all points
constexpr int kRangeRounds = 40;  // each narrows at least fourfold: enough for coordinates of 1e24 ranges
constexpr std::size_t kStraysDivisor = 200;  // at each end of each axis one point in so many may lie outside

struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// Values of one axis by where they lie in a range.
struct Histogram {
  std::size_t below = 0;
  std::size_t above = 0;
  std::array<std::size_t, kRangeBins> counts{};

  void join(const Histogram& other) {
    below += other.below;
    above += other.above;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) counts[bin] += other.counts[bin];
  }
};

Histogram histogram_of(std::span<const Vec3> points, int axis, const Range& range) {
  const double scale = kRangeBins / (range.high - range.low);
  Histogram result;
  for (const Vec3& p : points) {
    const double value = p[axis];
    if (value < range.low) {
      ++result.below;
    } else if (value > range.high) {
      ++result.above;
    } else {
      ++result.counts[static_cast<std::size_t>(std::min((value - range.low) * scale, kRangeBins - 1.0))];
    }
  }
  return result;
}

/// The part of `range` that holds all but one in kStraysDivisor values at each end, in whole bins.
Range narrowed(std::span<const Vec3> cloud, int axis, const Range& range, Workers& workers) {
  std::vector<Histogram> parts(Workers::parts(cloud.size()));
  workers.run_parts(cloud.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    parts[part] = histogram_of(cloud.subspan(begin, end - begin), axis, range);
  });
  Histogram all;
  for (const Histogram& part : parts) all.join(part);
  const double scale = kRangeBins / (range.high - range.low);
  const std::size_t strays = cloud.size() / kStraysDivisor;
  std::size_t first = 0;
  std::size_t last = kRangeBins - 1;
  while (first < last && all.below + all.counts[first] <= strays) all.below += all.counts[first++];
  while (last > first && all.above + all.counts[last] <= strays) all.above += all.counts[last--];
  return {range.low + static_cast<double>(first) / scale, range.low + static_cast<double>(last + 1) / scale};
}

/// The range of nearly all points along an axis, `range` being that of all: the same, unless a few strays far away make
/// it more than four times as long, for the Morton cells would be too coarse then.
Range robust_range(std::span<const Vec3> cloud, int axis, Range range, Workers& workers) {
  for (int round = 0; round < kRangeRounds; ++round) {
    const double length = range.high - range.low;
    const double finest = 1e-12 * std::max(std::abs(range.low), std::abs(range.high));
    if (length <= finest) break;
    const Range next = narrowed(cloud, axis, range, workers);
    if (next.high - next.low > 0.25 * length) break;
    range = next;
  }
  return range;
}

/// The box of all points.
Bounds bounds_of(std::span<const Vec3> cloud, Workers& workers) {
  std::vector<Bounds> parts(Workers::parts(cloud.size()));
  workers.run_parts(cloud.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    Bounds bounds{cloud[begin], cloud[begin]};
    for (std::size_t i = begin + 1; i < end; ++i) {
      bounds.low = bounds.low.cwiseMin(cloud[i]);
      bounds.high = bounds.high.cwiseMax(cloud[i]);
    }
    parts[part] = bounds;
  });
  Bounds all = parts.front();
  for (const Bounds& part : parts) {
    all.low = all.low.cwiseMin(part.low);
    all.high = all.high.cwiseMax(part.high);
  }
  return all;
}

}  // namespace

Bounds robust_bounds(std::span<const Vec3> cloud, Workers& workers) {
  Bounds bounds = bounds_of(cloud, workers);
  for (int axis = 0; axis < 3; ++axis) {
    const Range range = robust_range(cloud, axis, {bounds.low[axis], bounds.high[axis]}, workers);
    bounds.low[axis] = range.low;
    bounds.high[axis] = range.high;
  }
  return bounds;
}

}  // namespace hallway::em
