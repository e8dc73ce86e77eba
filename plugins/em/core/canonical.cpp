// SPDX-License-Identifier: MIT
#include "em/core/canonical.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace hallway::em {
namespace {

constexpr int kAxisBits = 12;   // 4096 cells along the longest side: about the spacing of a million points on surfaces
constexpr int kDigitBits = 12;  // three passes of the radix sort; a table of 4096 counters stays in the first cache
constexpr int kDigits = 3 * kAxisBits / kDigitBits;
constexpr int kIndexBits = 64 - 3 * kAxisBits;  // a word holds Morton code and index
constexpr std::uint64_t kIndexMask = (std::uint64_t{1} << kIndexBits) - 1;

constexpr int kRangeBins = 256;           // of the histogram that finds the range of nearly all points
constexpr int kRangeRounds = 40;          // each narrows at least fourfold: enough for coordinates of 1e24 ranges
constexpr std::size_t kStraysDivisor = 200;  // at each end of each axis one point in so many may lie outside

struct Range {
  double low = 0.0;
  double high = 0.0;
};

bool usable(const Vec3& p) {
  return (p.array().abs() <= kLargestCoordinate).all();
}

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

/// Bits 0..11 of `value` moved three apart.
std::uint64_t spread_bits(std::uint64_t value) {
  value = (value | (value << 16)) & 0x0000ff0000ffULL;
  value = (value | (value << 8)) & 0x00f00f00f00fULL;
  value = (value | (value << 4)) & 0x0c30c30c30c3ULL;
  value = (value | (value << 2)) & 0x249249249249ULL;
  return value;
}

std::uint64_t cell_of(double value, double low, double scale) {
  constexpr double kLast = (1 << kAxisBits) - 1;
  return static_cast<std::uint64_t>(std::clamp((value - low) * scale, 0.0, kLast));
}

/// Morton code above, index below; sorted by the code.
std::vector<std::uint64_t> sorted_words(const std::vector<Vec3>& cloud, const Vec3& low, double longest) {
  const double scale = longest > 0.0 ? (1 << kAxisBits) / longest : 0.0;
  std::vector<std::uint64_t> words(cloud.size());
  std::vector<std::array<std::uint32_t, 1 << kDigitBits>> places(kDigits);
  const auto digit = [](std::uint64_t word, int place) {
    return (word >> (kIndexBits + place * kDigitBits)) & ((1u << kDigitBits) - 1u);
  };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::uint64_t code = spread_bits(cell_of(cloud[i].x(), low.x(), scale)) |
                               spread_bits(cell_of(cloud[i].y(), low.y(), scale)) << 1 |
                               spread_bits(cell_of(cloud[i].z(), low.z(), scale)) << 2;
    words[i] = code << kIndexBits | i;
    for (int place = 0; place < kDigits; ++place) {
      ++places[static_cast<std::size_t>(place)][digit(words[i], place)];
    }
  }
  std::vector<std::uint64_t> moved(words.size());
  for (int place = 0; place < kDigits; ++place) {
    auto& starts = places[static_cast<std::size_t>(place)];
    std::uint32_t start = 0;
    for (std::uint32_t& entry : starts) start += std::exchange(entry, start);
    for (const std::uint64_t word : words) moved[starts[digit(word, place)]++] = word;
    words.swap(moved);
  }
  return words;
}

/// Sorts the words of equal code by exact coordinates, then by index.
void order_within_cells(const std::vector<Vec3>& cloud, std::vector<std::uint64_t>& words) {
  const auto before = [&cloud](std::uint64_t left, std::uint64_t right) {
    const Vec3& a = cloud[left & kIndexMask];
    const Vec3& b = cloud[right & kIndexMask];
    return std::tie(a.x(), a.y(), a.z(), left) < std::tie(b.x(), b.y(), b.z(), right);
  };
  for (auto run = words.begin(); run != words.end();) {
    auto end = run + 1;
    while (end != words.end() && *end >> kIndexBits == *run >> kIndexBits) ++end;
    if (end - run > 1) std::sort(run, end, before);
    run = end;
  }
}

}  // namespace

CanonicalCloud canonical_order(std::span<const Vec3> cloud) {
  if (cloud.size() > kIndexMask) throw std::length_error("a cloud of more than 2^28 points");
  std::vector<Vec3> finite;
  std::vector<PointIndex> index;
  finite.reserve(cloud.size());
  index.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!usable(cloud[i])) continue;
    finite.push_back(cloud[i]);
    index.push_back(static_cast<PointIndex>(i));
  }
  CanonicalCloud result;
  result.first.push_back(0);
  if (finite.empty()) return result;

  Vec3 low = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Range range = robust_range(finite, axis);
    low[axis] = range.low;
    result.extent[axis] = range.high - range.low;
    result.origin[axis] = range.low + 0.5 * (range.high - range.low);
  }
  std::vector<std::uint64_t> words = sorted_words(finite, low, result.extent.maxCoeff());
  order_within_cells(finite, words);

  result.points.resize(finite.size());
  result.given.reserve(finite.size());
  std::size_t places = 0;
  const Vec3* previous = nullptr;
  for (const std::uint64_t word : words) {
    const std::size_t i = word & kIndexMask;
    if (previous == nullptr || finite[i] != *previous) {
      result.points.set(places++, finite[i] - result.origin);
      result.first.push_back(0);
    }
    previous = &finite[i];
    result.given.push_back(index[i]);
    result.first.back() = static_cast<std::uint32_t>(result.given.size());
  }
  if (places < finite.size()) {
    Points unique;
    unique.resize(places);
    for (std::size_t i = 0; i < places; ++i) unique.set(i, result.points.at(i));
    result.points = std::move(unique);
  }
  return result;
}

}  // namespace hallway::em
