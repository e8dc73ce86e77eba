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
constexpr double kExactWay_m = 0.05;  // where there is no deviation
constexpr double kWander = 2.0;  // largest ratio of the variance of the newest ones to that of their steps
constexpr double kOneSigmas2 = 12.0;  // squared standard deviations by which one observation may differ
constexpr int kWindow = 8;            // observations in a mean of lengths
constexpr double kLengthSigmas = 4.0;
constexpr double kNoChange_m = 1e-3;

double square(double x) {
  return x * x;
}

/// Where the robot is as seen from an end of the plane that it sees.
Vec2 place_from(const TimedObservation& observation, int end) {
  return Pose2{Vec2::Zero(), observation.direction}.unrotate(-observation.segment.end[end]);
}

/// Mean of some lengths, and the sum of their squared steps.
struct Lengths {
  double mean = 0.0;
  double steps = 0.0;
};

Lengths lengths_of(const PlaneTrack& track, std::size_t begin, std::size_t count) {
  Lengths result;
  for (std::size_t i = begin; i < begin + count; ++i) {
    result.mean += track[i].length / static_cast<double>(count);
    if (i > begin) result.steps += square(track[i].length - track[i - 1].length);
  }
  return result;
}

}  // namespace

Vec2 end_offset(const TimedObservation& a, const TimedObservation& b, int combination) {
  const Vec2 p = b.segment.end[combination % 2] - a.segment.end[combination / 2];
  return Pose2{Vec2::Zero(), a.direction}.unrotate(p);
}

void NewestShared::collect() {
  std::size_t i = a_.lower_bound(last_ + 1), j = b_.lower_bound(last_ + 1);
  while (i > 0 && j > 0 && count_ < kMost) {
    const TimedObservation& in_a = a_[i - 1];
    const TimedObservation& in_b = b_[j - 1];
    if (in_a.iteration == in_b.iteration) {
      in_a_[count_] = &in_a;
      in_b_[count_++] = &in_b;
    }
    if (in_a.iteration >= in_b.iteration) --i;
    if (in_b.iteration >= in_a.iteration) --j;
  }
}

Vec2 NewestShared::latest(int combination) const {
  return end_offset(*a_.find(last_), *b_.find(last_), combination);
}

std::span<const Vec2> NewestShared::offsets(int combination, Iteration first) {
  const auto c = static_cast<std::size_t>(combination);
  if (count_ == 0) collect();
  if (!computed_[c]) {
    for (std::size_t i = 0; i < count_; ++i) offsets_[c][i] = end_offset(*in_a_[i], *in_b_[i], combination);
    computed_[c] = true;
  }
  std::size_t count = count_;
  while (count > 0 && in_a_[count - 1]->iteration < first) --count;
  return std::span<const Vec2>(offsets_[c]).first(count);
}

StillnessTest::StillnessTest(NewestShared& newest, Iteration first, const PairStatistics& sums)
    : newest_(newest), interval_{first, newest.last()}, sums_(sums) {
  if (interval_.empty()) return;
  up_to_first_ = sums.up_to(newest.a(), newest.b(), first - 1);
  up_to_last_ = sums.up_to(newest.a(), newest.b(), interval_.last);
  whole_ = up_to_last_;
  whole_ -= up_to_first_;
}

void StillnessTest::look_closer() {
  Details& details = details_.emplace();
  details.oldest = 0;
  const PlaneTrack& a = newest_.a();
  const PlaneTrack& b = newest_.b();
  const Iteration size = interval_.size();
  PairSums before = up_to_first_;
  for (std::size_t i = 0; i < kParts; ++i) {
    const auto next = static_cast<Iteration>(i) + 1;
    const PairSums here =
        i + 1 < kParts ? sums_.up_to(a, b, interval_.first + next * size / 4 - 1) : up_to_last_;
    details.parts[i] = here;
    details.parts[i] -= before;
    before = here;
  }
  details.tail = up_to_last_;
  details.tail -= sums_.up_to(a, b, interval_.last - kTail);
  std::size_t i = a.lower_bound(interval_.first), j = b.lower_bound(interval_.first);
  while (i < a.size() && j < b.size() && details.oldest < kOutermost) {
    const Iteration in_a = a[i].iteration, in_b = b[j].iteration;
    if (std::max(in_a, in_b) > interval_.last) break;
    if (in_a == in_b) {
      details.oldest_a[details.oldest] = &a[i];
      details.oldest_b[details.oldest++] = &b[j];
    }
    if (in_a <= in_b) ++i;
    if (in_b <= in_a) ++j;
  }
}

OffsetMoments StillnessTest::moments(int combination) const {
  return offset_moments(whole_, combination, kNoSize);
}

bool StillnessTest::drifts(int combination, const OffsetMoments& whole) const {
  double within = 0.0, between = 0.0;
  int parts = 0;
  for (const PairSums& part : details_->parts) {
    if (part.count < 2) continue;
    const OffsetMoments moments = offset_moments(part, combination, kNoSize);
    within += static_cast<double>(part.count) * square(moments.deviation);
    between += static_cast<double>(part.count) * (moments.mean - whole.mean).squaredNorm();
    ++parts;
  }
  if (parts < 2) return true;
  const double variance = within / static_cast<double>(whole_.count - parts);
  if (between / (parts - 1) > kBetween * variance + square(kNoDeviation_m)) return true;
  const PairSums& tail = details_->tail;
  if (tail.count < 2) return false;
  const Vec2 off = offset_moments(tail, combination, kNoSize).mean - whole.mean;
  return off.squaredNorm() * static_cast<double>(tail.count) >
         kTailSigmas2 * variance + square(kNoDeviation_m);
}

/// The longest way between places of the robot that the interval shows, if the end of a stands still.
double StillnessTest::travel(int combination) const {
  const PlaneTrack& a = newest_.a();
  std::array<Vec2, kParts> places;
  double farthest = 0.0;
  for (std::size_t i = 0; i < kParts;
       ++i) {  // in the middle of each part: the very first and last observations may be of something else
    const Iteration at = interval_.first + (2 * static_cast<Iteration>(i) + 1) * interval_.size() / 8;
    const TimedObservation& observation = a[std::min(a.lower_bound(at), a.size() - 1)];
    places[i] = place_from(observation, combination / 2);
    for (std::size_t j = 0; j < i; ++j) farthest = std::max(farthest, (places[i] - places[j]).norm());
  }
  return farthest;
}

/// Whether the offset wanders rather than jumps: its variance is larger than the steps from one observation to the next explain (von Neumann's ratio). Or the newest or the oldest ones lie off it.
bool StillnessTest::wanders(int combination, const OffsetMoments& whole) const {
  const std::span<const Vec2> offsets = newest_.offsets(combination, interval_.first);
  const std::size_t count = offsets.size();
  Vec2 mean = Vec2::Zero();
  for (const Vec2& offset : offsets) mean += offset / static_cast<double>(count);
  const double bound = kOneSigmas2 * square(whole.deviation);
  const auto off = [&](const Vec2& offset) { return (offset - whole.mean).squaredNorm() > bound; };
  double variance = 0.0, steps = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    variance += (offsets[i] - mean).squaredNorm();
    if (i > 0) steps += 0.5 * (offsets[i] - offsets[i - 1]).squaredNorm();
    if (i < kOutermost && off(offsets[i])) return true;
  }
  if (variance > kWander * steps + square(kNoDeviation_m)) return true;
  for (std::size_t i = 0; i < details_->oldest; ++i) {
    if (off(end_offset(*details_->oldest_a[i], *details_->oldest_b[i], combination))) return true;
  }
  return false;
}

Stillness StillnessTest::judge(int combination, double max_deviation_m) {
  if (whole_.count < kExactReadings) return Stillness::unknown;
  const OffsetMoments whole = moments(combination);
  if (whole.deviation > max_deviation_m) return Stillness::moves;
  double least_way = kExactWay_m;
  if (whole.deviation > kNoDeviation_m) {
    if (whole_.count < kReadings) return Stillness::unknown;
    if (!details_) look_closer();
    if (drifts(combination, whole) || wanders(combination, whole)) return Stillness::moves;
    const double n = static_cast<double>(whole_.count);
    least_way = whole.deviation * std::max(kWayDeviations, kWayOverNoise / std::sqrt(n));
  }
  return travel(combination) < least_way ? Stillness::unknown : Stillness::still;
}

bool length_changes(const PlaneTrack& track, const Interval& interval) {
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
