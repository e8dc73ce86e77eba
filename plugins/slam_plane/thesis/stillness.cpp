// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/stillness.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kNoSize[2] = {0.0, 0.0};
constexpr double kBetween = 6.0;  // largest ratio of the variance between the parts to that within them
constexpr double kTailSigmas2 =
    9.0;  // squared standard deviations by which the mean of the newest ones may differ
constexpr Iteration kTail = 12;         // newest iterations that are looked at by themselves
constexpr double kWayDeviations = 6.0;  // least way of the robot, in standard deviations of the offset
constexpr double kWayOverNoise =
    70.0;  // and in those of its mean: an end that moves by a tenth of the way moves by 2 sqrt(12) of them
constexpr double kExactWay_m = 0.05;   // where there is no deviation
constexpr std::size_t kWatched = 32;   // newest sightings that are looked at one by one
constexpr double kWander = 2.0;        // largest ratio of their variance to that of their steps
constexpr double kOneSigmas2 = 12.0;   // squared standard deviations by which one sighting may differ
constexpr std::size_t kOutermost = 3;  // newest and oldest ones that are asked for it
constexpr int kWindow = 8;             // sightings in a mean of lengths
constexpr double kLengthSigmas = 4.0;
constexpr double kNoChange_m = 1e-3;

double square(double x) {
  return x * x;
}

/// Where the robot is as seen from an end of the plane that it sees.
Vec2 place_from(const Sighting& sighting, int end) {
  return Pose2{Vec2::Zero(), sighting.direction}.unrotate(-sighting.segment.end[end]);
}

/// Mean of some lengths, and the sum of their squared steps.
struct Lengths {
  double mean = 0.0;
  double steps = 0.0;
};

Lengths lengths_of(const Track& track, std::size_t begin, std::size_t count) {
  Lengths result;
  for (std::size_t i = begin; i < begin + count; ++i) {
    result.mean += track[i].length / static_cast<double>(count);
    if (i > begin) result.steps += square(track[i].length - track[i - 1].length);
  }
  return result;
}

}  // namespace

Vec2 end_offset(const Sighting& a, const Sighting& b, int combination) {
  const Vec2 p = b.segment.end[combination % 2] - a.segment.end[combination / 2];
  return Pose2{Vec2::Zero(), a.direction}.unrotate(p);
}

StillnessTest::StillnessTest(const Track& a, const Track& b, const Interval& interval, PairComparer& comparer)
    : a_(a), b_(b), interval_(interval), whole_(comparer.sums_in(a, b, interval)) {
  if (whole_.count < kReadings) return;
  const Iteration size = interval.size();
  PairSums rest = whole_;
  for (std::size_t i = 0; i + 1 < kParts; ++i) {
    const auto at = static_cast<Iteration>(i);
    parts_[i] =
        comparer.sums_in(a, b, {interval.first + at * size / 4, interval.first + (at + 1) * size / 4 - 1});
    rest -= parts_[i];
  }
  parts_[kParts - 1] = rest;
  tail_ = comparer.sums_in(a, b, {interval.last - kTail + 1, interval.last});
}

OffsetMoments StillnessTest::moments(int combination) const {
  return offset_moments(whole_, combination, kNoSize);
}

bool StillnessTest::drifts(int combination, const OffsetMoments& whole) const {
  double within = 0.0, between = 0.0;
  int parts = 0;
  for (const PairSums& part : parts_) {
    if (part.count < 2) continue;
    const OffsetMoments moments = offset_moments(part, combination, kNoSize);
    within += static_cast<double>(part.count) * square(moments.deviation);
    between += static_cast<double>(part.count) * (moments.mean - whole.mean).squaredNorm();
    ++parts;
  }
  if (parts < 2) return true;
  const double variance = within / static_cast<double>(whole_.count - parts);
  if (between / (parts - 1) > kBetween * variance + square(kNoDeviation_m)) return true;
  if (tail_.count < 2) return false;
  const Vec2 off = offset_moments(tail_, combination, kNoSize).mean - whole.mean;
  return off.squaredNorm() * static_cast<double>(tail_.count) >
         kTailSigmas2 * variance + square(kNoDeviation_m);
}

/// The longest way between places of the robot that the interval shows, if the end of a stands still.
double StillnessTest::travel(int combination) const {
  std::array<Vec2, kParts> places;
  double farthest = 0.0;
  for (std::size_t i = 0; i < kParts;
       ++i) {  // in the middle of each part: the very first and last sightings may be of something else
    const Iteration at = interval_.first + (2 * static_cast<Iteration>(i) + 1) * interval_.size() / 8;
    const Sighting& sighting = a_[std::min(a_.lower_bound(at), a_.size() - 1)];
    places[i] = place_from(sighting, combination / 2);
    for (std::size_t j = 0; j < i; ++j) farthest = std::max(farthest, (places[i] - places[j]).norm());
  }
  return farthest;
}

/// Whether the offset wanders rather than jumps: its variance is larger than the steps from one sighting to the next explain (von Neumann's ratio). Or the newest or the oldest ones lie off it.
bool StillnessTest::wanders(int combination, const OffsetMoments& whole) const {
  std::array<Vec2, kWatched> offsets;  // the newest first
  std::size_t count = 0;
  for (Iteration k = interval_.last; k >= interval_.first && count < kWatched; --k) {
    const Sighting* in_a = a_.find(k);
    const Sighting* in_b = b_.find(k);
    if (in_a != nullptr && in_b != nullptr) offsets[count++] = end_offset(*in_a, *in_b, combination);
  }
  Vec2 mean = Vec2::Zero();
  for (std::size_t i = 0; i < count; ++i) mean += offsets[i] / static_cast<double>(count);
  const double bound = kOneSigmas2 * square(whole.deviation);
  double variance = 0.0, steps = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    variance += (offsets[i] - mean).squaredNorm();
    if (i > 0) steps += 0.5 * (offsets[i] - offsets[i - 1]).squaredNorm();
    if (i < kOutermost && (offsets[i] - whole.mean).squaredNorm() > bound) return true;
  }
  if (variance > kWander * steps + square(kNoDeviation_m)) return true;
  std::size_t oldest = 0;
  for (Iteration k = interval_.first; k <= interval_.last && oldest < kOutermost; ++k) {
    const Sighting* in_a = a_.find(k);
    const Sighting* in_b = b_.find(k);
    if (in_a == nullptr || in_b == nullptr) continue;
    if ((end_offset(*in_a, *in_b, combination) - whole.mean).squaredNorm() > bound) return true;
    ++oldest;
  }
  return false;
}

Stillness StillnessTest::judge(int combination, double max_deviation_m) const {
  if (whole_.count < kExactReadings) return Stillness::unknown;
  const OffsetMoments whole = moments(combination);
  if (whole.deviation > max_deviation_m) return Stillness::moves;
  double least_way = kExactWay_m;
  if (whole.deviation > kNoDeviation_m) {
    if (whole_.count < kReadings) return Stillness::unknown;
    if (drifts(combination, whole) || wanders(combination, whole)) return Stillness::moves;
    const double n = static_cast<double>(whole_.count);
    least_way = whole.deviation * std::max(kWayDeviations, kWayOverNoise / std::sqrt(n));
  }
  return travel(combination) < least_way ? Stillness::unknown : Stillness::still;
}

bool length_changes(const Track& track, const Interval& interval) {
  const std::size_t begin = track.lower_bound(interval.first);
  const std::size_t count = track.lower_bound(interval.last + 1) - begin;
  const std::size_t window = std::min<std::size_t>(kWindow, count / 3);
  if (window == 0) return false;
  const Lengths parts[3] = {lengths_of(track, begin, window),
                            lengths_of(track, begin + (count - window) / 2, window),
                            lengths_of(track, begin + count - window, window)};
  const auto [least, most] = std::minmax({parts[0].mean, parts[1].mean, parts[2].mean});
  const double steps = static_cast<double>(3 * (window - 1));
  const double variance =
      steps > 0.0 ? 0.5 * (parts[0].steps + parts[1].steps + parts[2].steps) / steps : 0.0;  // of one length
  const double sigma = std::sqrt(2.0 * variance / static_cast<double>(window));
  return most - least > std::max(kNoChange_m, kLengthSigmas * sigma);
}

}  // namespace hallway::slam_plane::thesis
