// SPDX-License-Identifier: MIT
#include "em/core/canonical.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "em/core/robust_range.hpp"

namespace hallway::em {
namespace {

constexpr int kAxisBits =
    12;  // 4096 cells along the longest side: about the spacing of a million points on surfaces
constexpr int kDigitBits =
    12;  // three passes of the radix sort; a table of 4096 counters stays in the first cache
constexpr int kDigits = 3 * kAxisBits / kDigitBits;
constexpr int kIndexBits = 64 - 3 * kAxisBits;  // a word holds Morton code and index
constexpr std::uint64_t kIndexMask = (std::uint64_t{1} << kIndexBits) - 1;

bool usable(const Vec3& p) {
  return (p.array().abs() <= kLargestCoordinate).all();
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

  result.frame = principal_frame(finite);
  for (Vec3& p : finite) p = result.frame.from_cloud(p);
  const Bounds bounds = robust_bounds(finite);
  const double longest = (bounds.high - bounds.low).maxCoeff();
  std::vector<std::uint64_t> words = sorted_words(finite, bounds.low, longest);
  order_within_cells(finite, words);

  result.points.resize(finite.size());
  result.given.reserve(finite.size());
  std::size_t places = 0;
  const Vec3* previous = nullptr;
  for (const std::uint64_t word : words) {
    const std::size_t i = word & kIndexMask;
    if (previous == nullptr || finite[i] != *previous) {
      result.points.set(places++, finite[i]);
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
