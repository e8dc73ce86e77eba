// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "slam_plane/thesis/plane_track.hpp"

namespace hallway::slam_plane::thesis {
namespace {

/// Straight from the observations.
IntervalSummary summarize(const PlaneTrack& a, const PlaneTrack& b, const Interval& interval,
                          const CompareOptions& options) {
  IntervalSummary summary;
  summary.interval = interval;
  const PlaneTrack* tracks[2] = {&a, &b};
  for (int t = 0; t < 2; ++t) {
    LargestLengths largest;
    for (std::size_t i = tracks[t]->lower_bound(interval.first); i < tracks[t]->size(); ++i) {
      const TimedObservation& observation = (*tracks[t])[i];
      if (observation.iteration > interval.last) break;
      largest.add(observation.length, observation.iteration);
    }
    summary.size[t] = backed_size(largest, options);
  }
  for_each_shared(a, b, interval, [&](const TimedObservation& sa, const TimedObservation& sb) {
    if (!summary.size[0].excludes(sa.iteration) && !summary.size[1].excludes(sa.iteration))
      summary.sums += sums_of(sa, sb);
  });
  return summary;
}

constexpr double kConflictSigmas = 5.0;
constexpr double kLeastConflict_m = 2e-3;

/// From the key point of a to that of b, in a's frame.
Vec2 between_keys(const Comparison& comparison) {
  return comparison.placement(1).segment().end[end_of(comparison.key[1])] -
         comparison.placement(0).segment().end[end_of(comparison.key[0])];
}

double variance_of_mean(const Comparison& comparison) {
  return comparison.deviation * comparison.deviation / std::max(1, comparison.shared);
}

}  // namespace

Segment Placement::segment() const {
  return {{middle - 0.5 * size * direction, middle + 0.5 * size * direction}};
}

Placement Comparison::placement(int which) const {
  if (which == 0) return {Vec2::Zero(), Vec2(1.0, 0.0), size[0], valid};
  return {offset, direction, size[1], valid};
}

Comparison inverse(const Comparison& comparison) {
  Comparison result = comparison;
  const Pose2 T_a_b{comparison.offset, comparison.direction};
  const Pose2 T_b_a = T_a_b.inverse();
  result.offset = T_b_a.t;
  result.direction = T_b_a.r;
  std::swap(result.size[0], result.size[1]);
  std::swap(result.key[0], result.key[1]);
  return result;
}

Comparison evaluate(const IntervalSummary& summary, int combination, const CompareOptions& options) {
  Comparison comparison;
  comparison.interval = summary.interval;
  comparison.shared = static_cast<int>(summary.sums.count);
  for (int i = 0; i < 2; ++i) comparison.size[i] = summary.size[i].size;
  if (comparison.shared < options.min_shared) return comparison;
  const OffsetMoments moments = offset_moments(summary.sums, combination, comparison.size);
  comparison.valid = true;
  comparison.offset = moments.mean;
  comparison.deviation = moments.deviation;
  comparison.direction = mean_direction(summary.sums);
  comparison.parallel = std::abs(comparison.direction.y()) <= std::sin(radians(options.parallel_deg));
  for (int i = 0; i < 2; ++i) comparison.key[i] = key_of(combination, i);
  return comparison;
}

Comparison compare_uncached_in(const PlaneTrack& a, const PlaneTrack& b, const Interval& interval,
                               int combination, const CompareOptions& options) {
  if (b.id() < a.id())
    return inverse(compare_uncached_in(b, a, interval, turned_round(combination), options));
  return evaluate(summarize(a, b, interval, options), combination, options);
}

EndConflict conflict_between(const Comparison& older, const Comparison& newer) {
  EndConflict result;
  const Vec2 d = between_keys(newer) - between_keys(older);
  const double sigma = std::sqrt(variance_of_mean(older) + variance_of_mean(newer));
  if (d.norm() <= kLeastConflict_m + kConflictSigmas * sigma) return result;
  result.any = true;
  const double farther[2] = {newer.key[0] == KeyPoint::right ? -d.x() : d.x(),
                             d.dot(newer.direction) * outward(end_of(newer.key[1]))};
  result.which = std::abs(farther[0]) > std::abs(farther[1]) ? 0 : 1;
  result.newer_right = farther[result.which] > 0.0;
  return result;
}

}  // namespace hallway::slam_plane::thesis
