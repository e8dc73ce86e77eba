// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "slam_plane/thesis/shared_sightings.hpp"

namespace hallway::slam_plane::thesis {
namespace {

bool close(double smaller, double larger, const CompareOptions& options) {
  return larger <= options.close_ratio * smaller + options.close_floor_m;
}

/// Rule 15: the ends that move together fit as well as those that stand still.
bool symmetric(const Comparison& comparison, std::size_t best, const CompareOptions& options) {
  const std::array<double, 4>& deviations = comparison.deviations;
  if (!comparison.parallel || !close(deviations[best], deviations[3 - best], options)) return false;
  const double others = std::min(deviations[best ^ 1], deviations[best ^ 2]);
  return !close(deviations[3 - best], others, options);
}

double total_size(const IntervalSummary& summary) {
  return summary.size[0].size + summary.size[1].size;
}

/// Straight from the sightings.
IntervalSummary summarize(const Track& a, const Track& b, const Interval& interval,
                          const CompareOptions& options) {
  IntervalSummary summary;
  summary.interval = interval;
  const Track* tracks[2] = {&a, &b};
  for (int t = 0; t < 2; ++t) {
    LargestLengths largest;
    for (std::size_t i = tracks[t]->lower_bound(interval.first); i < tracks[t]->size(); ++i) {
      const Sighting& sighting = (*tracks[t])[i];
      if (sighting.iteration > interval.last) break;
      largest.add(sighting.length, sighting.iteration);
    }
    summary.size[t] = backed_size(largest, options);
  }
  for_each_shared(a, b, interval, [&](const Sighting& sa, const Sighting& sb) {
    if (!summary.size[0].excludes(sa.iteration) && !summary.size[1].excludes(sa.iteration))
      summary.sums += sums_of(sa, sb);
  });
  return summary;
}

}  // namespace

Segment Placement::segment() const {
  return {{middle - 0.5 * size * direction, middle + 0.5 * size * direction}};
}

Placement Comparison::placement(int which) const {
  if (which == 0) return {Vec2::Zero(), Vec2(1.0, 0.0), size[0], key[0], interval, valid};
  return {offset, direction, size[1], key[1], interval, valid};
}

Comparison inverse(const Comparison& comparison) {
  Comparison result = comparison;
  const Pose2 T_a_b{comparison.offset, comparison.direction};
  const Pose2 T_b_a = T_a_b.inverse();
  result.offset = T_b_a.t;
  result.direction = T_b_a.r;
  std::swap(result.size[0], result.size[1]);
  std::swap(result.key[0], result.key[1]);
  std::swap(result.deviations[1], result.deviations[2]);
  return result;
}

Intervals comparable_intervals(const Track& a, const Track& b) {
  Intervals result;
  const auto& pa = a.phases();
  const auto& pb = b.phases();
  for (std::size_t i = 0, j = 0; i < pa.size() && j < pb.size();) {
    const Interval both = intersection(pa[i].interval, pb[j].interval);
    if (!both.empty()) result.push_back(both);
    if (pa[i].interval.last < pb[j].interval.last) {
      ++i;
    } else {
      ++j;
    }
  }
  if (result.size() > kMaxIntervals)
    result.erase(result.begin(), result.end() - static_cast<std::ptrdiff_t>(kMaxIntervals));
  return result;
}

const IntervalSummary* best_summary(std::span<const IntervalSummary> summaries,
                                    const CompareOptions& options) {
  const auto enough = [&](const IntervalSummary& summary) {
    return summary.sums.count >= options.min_shared;
  };
  double largest = -1.0;
  for (const IntervalSummary& summary : summaries) {
    if (enough(summary)) largest = std::max(largest, total_size(summary));
  }
  const IntervalSummary* best = nullptr;
  for (const IntervalSummary& summary : summaries) {
    if (largest >= 0.0 && (!enough(summary) || total_size(summary) < largest - options.similar_size_m))
      continue;
    if (best == nullptr || summary.sums.count >= best->sums.count) best = &summary;
  }
  return best;
}

Comparison evaluate(const IntervalSummary& summary, const CompareOptions& options) {
  Comparison comparison;
  comparison.interval = summary.interval;
  comparison.shared = static_cast<int>(summary.sums.count);
  for (int i = 0; i < 2; ++i) comparison.size[i] = summary.size[i].size;
  if (comparison.shared == 0) return comparison;

  std::array<Vec2, 4> offsets;
  for (std::size_t c = 0; c < 4; ++c) {
    const OffsetMoments moments = offset_moments(summary.sums, static_cast<int>(c), comparison.size);
    offsets[c] = moments.mean;
    comparison.deviations[c] = moments.deviation;
  }
  const auto best =
      static_cast<std::size_t>(std::min_element(comparison.deviations.begin(), comparison.deviations.end()) -
                               comparison.deviations.begin());
  comparison.direction = mean_direction(summary.sums);
  comparison.parallel =
      std::abs(comparison.direction.y()) <= std::sin(options.parallel_deg * std::numbers::pi / 180.0);
  comparison.offset = offsets[best];
  comparison.deviation = comparison.deviations[best];
  comparison.valid = comparison.shared >= options.min_shared &&
                     (options.max_deviation_m <= 0.0 || comparison.deviation <= options.max_deviation_m);
  if (!comparison.valid) return comparison;
  if (symmetric(comparison, best, options)) {
    // Both tell the same offset, or, if a gap between two planes of one line moves, nobody knows which is right.
    comparison.valid = (offsets[3 - best] - comparison.offset).norm() <= options.similar_size_m;
    return comparison;
  }
  comparison.key[0] = best / 2 == 0 ? KeyPoint::left : KeyPoint::right;
  comparison.key[1] = best % 2 == 0 ? KeyPoint::left : KeyPoint::right;
  return comparison;
}

Comparison compare_uncached(const Track& a, const Track& b, const CompareOptions& options) {
  if (b.id() < a.id()) return inverse(compare_uncached(b, a, options));
  std::vector<IntervalSummary> summaries;
  for (const Interval& interval : comparable_intervals(a, b))
    summaries.push_back(summarize(a, b, interval, options));
  const IntervalSummary* best = best_summary(summaries, options);
  return best == nullptr ? Comparison{} : evaluate(*best, options);
}

Comparison compare_uncached_in(const Track& a, const Track& b, const Interval& interval,
                               const CompareOptions& options) {
  if (b.id() < a.id()) return inverse(compare_uncached_in(b, a, interval, options));
  return evaluate(summarize(a, b, interval, options), options);
}

}  // namespace hallway::slam_plane::thesis
