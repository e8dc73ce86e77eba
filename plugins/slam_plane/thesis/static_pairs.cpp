// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/static_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kFloor_m = 1e-4;  // deviations and differences below it are none
constexpr int kExactReadings = 3;  // enough where there is no deviation at all
constexpr int kReadings = 8;       // enough otherwise
constexpr double kMeans = 9.0;     // squared standard deviations by which the means of two halves may differ
constexpr double kVariances = 10.0;   // ratio of the variances of two halves
constexpr double kWander = 2.0;       // largest ratio of the variance to that of steps
constexpr std::size_t kWatched = 32;  // newest sightings that are asked for that
constexpr double kSample = 16.0;      // squared standard deviations by which one sighting may differ
constexpr int kEvaluateEvery = 4;     // new sightings
constexpr int kLongestSearch = 400;   // iterations
constexpr double kNoSize[2] = {0.0, 0.0};

double square(double x) {
  return x * x;
}

/// The offset between two ends in one iteration.
Vec2 offset_of(const Sighting& a, const Sighting& b, int combination) {
  const Vec2 p = b.segment.end[combination % 2] - a.segment.end[combination / 2];
  return Pose2{Vec2::Zero(), a.direction}.unrotate(p);
}

bool parallel(const Sighting& a, const Sighting& b, double degrees) {
  return std::abs(cross(a.direction, b.direction)) <= std::sin(degrees * std::numbers::pi / 180.0);
}

int combination_of(const Comparison& comparison) {
  return (comparison.key[0] == KeyPoint::right ? 2 : 0) + (comparison.key[1] == KeyPoint::right ? 1 : 0);
}

/// Whether a sighting agrees with the mean of a block.
bool agrees(const Sighting& a, const Sighting& b, int combination, const OffsetMoments& moments) {
  const double bound = kSample * square(moments.deviation) + square(kFloor_m);
  return (offset_of(a, b, combination) - moments.mean).squaredNorm() <= bound;
}

void save(const Comparison& comparison, PairHistory& pair) {
  const int combination = combination_of(comparison);
  const auto same = std::find_if(pair.saved.begin(), pair.saved.end(), [&](const Comparison& other) {
    return combination_of(other) == combination;
  });
  if (same == pair.saved.end()) {
    pair.saved.push_back(comparison);
  } else if (comparison.shared >= same->shared) {
    *same = comparison;
  }
  std::stable_sort(pair.saved.begin(), pair.saved.end(),
                   [](const Comparison& a, const Comparison& b) { return a.shared > b.shared; });
}

/// The iteration in the middle of those in which the plane seen less often was seen.
Iteration middle_of(const Track& a, const Track& b, const Interval& interval) {
  const Track* rare = nullptr;
  std::size_t from = 0, count = 0;
  for (const Track* track : {&a, &b}) {
    const std::size_t begin = track->lower_bound(interval.first);
    const std::size_t size = track->lower_bound(interval.last + 1) - begin;
    if (rare != nullptr && size >= count) continue;
    rare = track;
    from = begin;
    count = size;
  }
  return count < 2 ? interval.first : (*rare)[from + count / 2 - 1].iteration;
}

/// Whether the offset of two ends wanders rather than jumps: its variance is larger than steps from one sighting to the next explain (von Neumann's ratio).
bool wanders(const Track& a, const Track& b, const Interval& interval, int combination) {
  std::vector<Vec2> offsets;
  for (Iteration k = interval.last; k >= interval.first && offsets.size() < kWatched; --k) {
    const Sighting* in_a = a.find(k);
    const Sighting* in_b = b.find(k);
    if (in_a != nullptr && in_b != nullptr) offsets.push_back(offset_of(*in_a, *in_b, combination));
  }
  Vec2 mean = Vec2::Zero();
  for (const Vec2& offset : offsets) mean += offset / static_cast<double>(offsets.size());
  double variance = 0.0, steps = 0.0;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    variance += (offsets[i] - mean).squaredNorm();
    if (i > 0) steps += 0.5 * (offsets[i] - offsets[i - 1]).squaredNorm();
  }
  return variance > kWander * steps + square(kFloor_m);
}

/// What a run saved that turned out to drift does not count.
void drop_run(Iteration since, PairHistory& pair) {
  std::erase_if(pair.saved, [&](const Comparison& saved) { return saved.interval.first == since; });
}

}  // namespace

std::optional<StaticPairs::Block> StaticPairs::still(const Track& a, const Track& b,
                                                     const Interval& interval) {
  Block block{comparer_.sums_in(a, b, interval), 0};
  const std::int64_t n = block.sums.count;
  if (n < kExactReadings) return std::nullopt;
  OffsetMoments whole;
  for (int c = 0; c < 4; ++c) {
    const OffsetMoments moments = offset_moments(block.sums, c, kNoSize);
    if (c > 0 && moments.deviation >= whole.deviation) continue;
    whole = moments;
    block.combination = c;
  }
  if (whole.deviation > options_.max_deviation_m) return std::nullopt;
  block.exact = whole.deviation <= kFloor_m;
  if (block.exact) return block;
  if (n < kReadings) return std::nullopt;
  const PairSums first = comparer_.sums_in(a, b, {interval.first, middle_of(a, b, interval)});
  PairSums second = block.sums;
  second -= first;
  if (first.count < kReadings / 2 || second.count < kReadings / 2) return std::nullopt;
  const OffsetMoments m1 = offset_moments(first, block.combination, kNoSize);
  const OffsetMoments m2 = offset_moments(second, block.combination, kNoSize);
  const double v1 = square(m1.deviation), v2 = square(m2.deviation), floor = square(kFloor_m);
  const double of_mean = 0.5 * (v1 + v2) * 4.0 / static_cast<double>(n);
  if ((m1.mean - m2.mean).squaredNorm() > kMeans * of_mean + floor) return std::nullopt;
  if (std::max(v1, v2) > kVariances * std::min(v1, v2) + floor) return std::nullopt;
  if (wanders(a, b, interval, block.combination)) return std::nullopt;
  return block;
}

void StaticPairs::evaluate(const Track& a, const Track& b, PairHistory& pair) {
  pair.current = comparer_.compare_in(a, b, {pair.since, pair.updated});
  if (!pair.current.has_keys()) {
    pair.since = -1;
    return;
  }
  save(pair.current, pair);
}

/// Whether the newest sightings agree with the current comparison; notes which ends of both do.
bool StaticPairs::goes_on(const Track& a, const Track& b, PairHistory& pair) {
  const PairSums sums = comparer_.sums_in(a, b, pair.current.interval);
  if (sums.count == 0) return false;
  const int main = combination_of(pair.current);
  const double least = offset_moments(sums, main, kNoSize).deviation;
  bool result = false;
  for (auto& plane : pair.still) plane[0] = plane[1] = false;
  for (int c = 0; c < 4; ++c) {
    const OffsetMoments moments = offset_moments(sums, c, kNoSize);
    if (moments.deviation > options_.close_ratio * least + kFloor_m) continue;
    if (!agrees(*a.find(pair.updated), *b.find(pair.updated), c, moments)) continue;
    pair.still[0][c / 2] = pair.still[1][c % 2] = true;
    result = result || c == main;
  }
  return result;
}

void StaticPairs::extend(const Track& a, const Track& b, PairHistory& pair) {
  const Interval interval{pair.since, pair.updated};
  const std::optional<Block> block = still(a, b, interval);
  if (block) {
    evaluate(a, b, pair);
    return;
  }
  drop_run(pair.since, pair);
  pair.since = -1;
}

void StaticPairs::search(const Track& a, const Track& b, PairHistory& pair) {
  pair.since = -1;
  std::optional<Block> best;
  for (Iteration length = kExactReadings; length <= kLongestSearch; length += length / 2) {
    const Interval interval{pair.updated - length + 1, pair.updated};
    const std::optional<Block> block = still(a, b, interval);
    if (block && best && block->sums.count == best->sums.count) break;  // there is nothing older
    if (block && best && best->exact && !block->exact) break;
    if (block) {
      best = block;
      pair.since = interval.first;
    } else if (best || length >= 2 * kReadings) {
      break;
    }
  }
  if (!best) return;
  for (const Track* track : {&a, &b})  // both were seen all the time
    pair.since = std::max(pair.since, (*track)[track->lower_bound(pair.since)].iteration);
  const OffsetMoments moments = offset_moments(best->sums, best->combination, kNoSize);
  for (Iteration k = pair.since - 1; k >= pair.updated - kLongestSearch; --k) {
    const Sighting* in_a = a.find(k);
    const Sighting* in_b = b.find(k);
    if (in_a == nullptr || in_b == nullptr || !agrees(*in_a, *in_b, best->combination, moments)) break;
    pair.since = k;
  }
  evaluate(a, b, pair);
}

const PairHistory& StaticPairs::update(const Track& a, const Track& b) {
  if (b.id() < a.id()) return update(b, a);
  PairHistory& pair = pairs_[{a.id(), b.id()}];
  if (a.empty() || b.empty()) return pair;
  const Iteration last = std::min(a.newest().iteration, b.newest().iteration);
  const Sighting* in_a = a.find(last);
  const Sighting* in_b = b.find(last);
  if (last <= pair.updated || in_a == nullptr || in_b == nullptr) return pair;
  const Iteration since_last = last - pair.updated;
  pair.updated = last;
  if (parallel(*in_a, *in_b, options_.parallel_deg)) return pair;
  if (pair.since >= 0) {
    if (!goes_on(a, b, pair)) {
      pair.since = -1;
    } else if (last - pair.current.interval.last >= kEvaluateEvery || since_last > 1 ||
               pair.current.shared < kReadings) {
      extend(a, b, pair);
    }
  }
  if (pair.since < 0) {
    search(a, b, pair);
    if (pair.since >= 0) goes_on(a, b, pair);
  }
  return pair;
}

void StaticPairs::truncate(Iteration k) {
  comparer_.truncate(k);
  for (auto& [key, pair] : pairs_) {
    if (pair.updated <= k) continue;
    std::erase_if(pair.saved, [&](const Comparison& saved) { return saved.interval.last > k; });
    pair.updated = pair.since = -1;
  }
}

void StaticPairs::forget(TrackId id) {
  comparer_.forget(id);
  std::erase_if(pairs_,
                [&](const auto& entry) { return entry.first.first == id || entry.first.second == id; });
}

}  // namespace hallway::slam_plane::thesis
