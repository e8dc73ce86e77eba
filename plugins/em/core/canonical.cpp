// SPDX-License-Identifier: MIT
#include "em/core/canonical.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "em/core/robust_range.hpp"
#include "geometry/morton.hpp"

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

std::uint64_t cell_of(double value, double low, double scale) {
  constexpr double kLast = (1 << kAxisBits) - 1;
  return static_cast<std::uint64_t>(std::clamp((value - low) * scale, 0.0, kLast));
}

/// Morton code above, index below.
RawVector<std::uint64_t> words_of(std::span<const Vec3> cloud, const Bounds& bounds, Workers& workers) {
  const double longest = (bounds.high - bounds.low).maxCoeff();
  const double scale = longest > 0.0 ? (1 << kAxisBits) / longest : 0.0;
  RawVector<std::uint64_t> words(cloud.size());
  workers.run_parts(cloud.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& p = cloud[i];
      const std::uint64_t code =
          morton_code(cell_of(p.x(), bounds.low.x(), scale), cell_of(p.y(), bounds.low.y(), scale),
                      cell_of(p.z(), bounds.low.z(), scale));
      words[i] = code << kIndexBits | i;
    }
  });
  return words;
}

using DigitCounts = std::array<std::uint32_t, 1 << kDigitBits>;

std::size_t digit_of(std::uint64_t word, int place) {
  return (word >> (kIndexBits + place * kDigitBits)) & ((1u << kDigitBits) - 1u);
}

/// Turns how often each digit occurs in each slice into where the first one goes.
void make_starts(std::vector<DigitCounts>& slices) {
  std::uint32_t start = 0;
  for (std::size_t digit = 0; digit < slices.front().size(); ++digit) {
    for (DigitCounts& slice : slices) start += std::exchange(slice[digit], start);
  }
}

/// Sorts by the code, equal ones by the order given. Each thread counts and moves a slice of the words; a stable sort has
/// one result, however they are cut.
void sort_by_code(RawVector<std::uint64_t>& words, Workers& workers) {
  const std::size_t slices = std::min(workers.count(), Workers::parts(words.size()));
  const auto begin_of = [&](std::size_t slice) { return slice * words.size() / slices; };
  std::vector<DigitCounts> starts(slices);
  RawVector<std::uint64_t> moved(words.size());
  for (int place = 0; place < kDigits; ++place) {
    workers.run(slices, [&](std::size_t slice, std::size_t) {
      starts[slice].fill(0);
      for (std::size_t k = begin_of(slice); k < begin_of(slice + 1); ++k)
        ++starts[slice][digit_of(words[k], place)];
    });
    make_starts(starts);
    workers.run(slices, [&](std::size_t slice, std::size_t) {
      for (std::size_t k = begin_of(slice); k < begin_of(slice + 1); ++k) {
        moved[starts[slice][digit_of(words[k], place)]++] = words[k];
      }
    });
    words.swap(moved);
  }
}

/// Sorts the words of equal code by exact coordinates, then by index.
void order_within_cells(std::span<const Vec3> cloud, RawVector<std::uint64_t>& words, Workers& workers) {
  const auto same_cell = [&words](std::size_t k) {
    return words[k] >> kIndexBits == words[k - 1] >> kIndexBits;
  };
  const auto before = [&cloud](std::uint64_t left, std::uint64_t right) {
    const Vec3& a = cloud[left & kIndexMask];
    const Vec3& b = cloud[right & kIndexMask];
    return std::tie(a.x(), a.y(), a.z(), left) < std::tie(b.x(), b.y(), b.z(), right);
  };
  std::vector<std::size_t> edges;  // parts, moved on to where a cell begins
  for (std::size_t part = 0; part < Workers::parts(words.size()); ++part) {
    std::size_t edge = part * Workers::kPart;
    while (edge > 0 && edge < words.size() && same_cell(edge)) ++edge;
    edges.push_back(edge);
  }
  edges.push_back(words.size());
  workers.run(edges.size() - 1, [&](std::size_t part, std::size_t) {
    for (std::size_t begin = edges[part]; begin < edges[part + 1];) {
      std::size_t end = begin + 1;
      while (end < edges[part + 1] && same_cell(end)) ++end;
      if (end - begin > 1) std::sort(words.data() + begin, words.data() + end, before);
      begin = end;
    }
  });
}

/// For each count the sum of those before it; then the sum of all.
std::vector<std::size_t> starts_of(const std::vector<std::size_t>& counts) {
  std::vector<std::size_t> starts(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
  return starts;
}

/// The usable points, and their indices in the cloud.
struct Usable {
  RawVector<Vec3> points;
  RawVector<PointIndex> index;
};

Usable usable_of(std::span<const Vec3> cloud, Workers& workers) {
  std::vector<std::size_t> counts(Workers::parts(cloud.size()));
  workers.run_parts(cloud.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    const auto points = cloud.subspan(begin, end - begin);
    counts[part] = static_cast<std::size_t>(std::count_if(points.begin(), points.end(), usable));
  });
  const std::vector<std::size_t> starts = starts_of(counts);
  Usable result;
  result.points.resize(starts.back());
  result.index.resize(starts.back());
  workers.run_parts(cloud.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::size_t next = starts[part];
    for (std::size_t i = begin; i < end; ++i) {
      if (!usable(cloud[i])) continue;
      result.points[next] = cloud[i];
      result.index[next++] = static_cast<PointIndex>(i);
    }
  });
  return result;
}

/// Fills in the points in the order of the words, each place once.
void take_places(const Usable& usable, const RawVector<std::uint64_t>& words, Workers& workers,
                 CanonicalCloud& result) {
  const auto point = [&](std::size_t k) -> const Vec3& { return usable.points[words[k] & kIndexMask]; };
  const auto is_new = [&](std::size_t k) { return k == 0 || point(k) != point(k - 1); };
  std::vector<std::size_t> counts(Workers::parts(words.size()), 0);
  workers.run_parts(words.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::size_t count = 0;
    for (std::size_t k = begin; k < end; ++k) count += is_new(k) ? 1u : 0u;
    counts[part] = count;
  });
  const std::vector<std::size_t> starts = starts_of(counts);
  result.points.resize(starts.back());
  result.given.resize(words.size());
  result.first.resize(starts.back() + 1);
  result.first.back() = static_cast<std::uint32_t>(words.size());
  workers.run_parts(words.size(), [&](std::size_t part, std::size_t begin, std::size_t end) {
    std::size_t place = starts[part];
    for (std::size_t k = begin; k < end; ++k) {
      result.given[k] = usable.index[words[k] & kIndexMask];
      if (!is_new(k)) continue;
      result.points.set(place, point(k));
      result.first[place++] = static_cast<std::uint32_t>(k);
    }
  });
}

}  // namespace

CanonicalCloud canonical_order(std::span<const Vec3> cloud, Workers& workers) {
  if (cloud.size() > kIndexMask) throw std::length_error("a cloud of more than 2^28 points");
  CanonicalCloud result;
  Usable usable = usable_of(cloud, workers);
  if (usable.points.empty()) {
    result.first.push_back(0);
    return result;
  }
  result.frame = principal_frame(usable.points, workers);
  workers.run_parts(usable.points.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) usable.points[i] = result.frame.from_cloud(usable.points[i]);
  });
  RawVector<std::uint64_t> words = words_of(usable.points, robust_bounds(usable.points, workers), workers);
  sort_by_code(words, workers);
  order_within_cells(usable.points, words, workers);
  take_places(usable, words, workers, result);
  return result;
}

}  // namespace hallway::em
