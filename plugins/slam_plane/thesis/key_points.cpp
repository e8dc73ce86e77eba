// SPDX-License-Identifier: MIT
// The part of StaticPairs that judges what was found: which ends that stand still to each other are key points, and which comparison is kept.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "slam_plane/thesis/comparison.hpp"
#include "slam_plane/thesis/static_pairs.hpp"

namespace hallway::slam_plane::thesis {
namespace {

constexpr Iteration kFirmFor = 4;  // iterations for which another pair's word counts

/// Of two runs that tell both ends of a plane to stand still, though its length changes: which one is right? Positive: the first one. 0: nobody knows.
int better(const EndRun& first, const EndRun& second, Iteration now, double ratio) {
  const auto length = [&](const EndRun& run) { return static_cast<double>(now - run.since + 1); };
  if (length(first) > ratio * length(second)) return 1;
  if (length(second) > ratio * length(first)) return -1;
  if (ratio * first.moments.deviation + kNoDeviation_m < second.moments.deviation) return 1;
  if (ratio * second.moments.deviation + kNoDeviation_m < first.moments.deviation) return -1;
  return 0;
}

/// Of two runs that tell both ends of a plane to stand still the one is left out that is worse, or both, if the plane's length changes: then one end moves (Rules 13, 15).
void leave_one_end(const PlaneTrack& track, double ratio, Iteration now, EndRun& left, EndRun& right) {
  if (left.since < 0 || right.since < 0) return;
  if (!length_changes(track, {std::max(left.since, right.since), now})) return;
  const int sign = better(left, right, now, ratio);
  if (sign <= 0) left.undefined = true;
  if (sign >= 0) right.undefined = true;
}

void leave_one_end(const PlaneTrack& a, const PlaneTrack& b, double ratio, PairHistory& pair) {
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t d = 0; d < c; ++d) {
      if (c / 2 != d / 2) leave_one_end(a, ratio, pair.updated, pair.runs[d], pair.runs[c]);
      if (c % 2 != d % 2) leave_one_end(b, ratio, pair.updated, pair.runs[d], pair.runs[c]);
    }
  }
}

}  // namespace

/// Of comparisons of the same ends the longer one is kept (Rule 36), and of one run the newer one. If they contradict each other it is the one in which the plane reaches farther, and what else is
/// known of the other one's end is not of its corner.
void StaticPairs::keep_better(const PlaneTrack& a, const PlaneTrack& b, const Comparison& made,
                              PairHistory& pair) {
  const auto same =
      std::ranges::find_if(pair.saved, [&](const Comparison& other) { return other.same_ends(made); });
  if (same == pair.saved.end()) {
    pair.saved.push_back(made);
    return;
  }
  const bool same_run = same->interval.first == made.interval.first;
  const EndConflict conflict = made.has_keys() && !same_run ? conflict_between(*same, made) : EndConflict{};
  if (conflict.any && conflict.newer_right) {
    const TrackId track = conflict.which == 0 ? a.id() : b.id();
    corner_since_[{track, made.key[conflict.which]}] = made.interval.first;
    ++disproved_;
  }
  if (conflict.any ? conflict.newer_right : same_run || made.shared >= same->shared) *same = made;
}

/// Forgets what was found of ends that turned out not to be corners.
void StaticPairs::drop_disproved(const PlaneTrack& a, const PlaneTrack& b, PairHistory& pair) {
  if (corner_since_.empty() || pair.disproved == disproved_) return;
  pair.disproved = disproved_;
  std::erase_if(pair.saved, [&](const Comparison& saved) {
    for (const int which : {0, 1}) {
      const auto since = corner_since_.find({which == 0 ? a.id() : b.id(), saved.key[which]});
      if (since != corner_since_.end() && saved.interval.last < since->second) return true;
    }
    return false;
  });
}

/// Ends of parallel planes that move alike stand still to each other, and the pair does not tell them from ends that do (Rule 15). So it has no key points where both planes change their length,
/// until that went on for long; nor where a plane's length changes while another pair, of planes that are not parallel, tells that its other end stands still.
bool StaticPairs::may_move_alike(const PlaneTrack& a, const PlaneTrack& b, int combination, const EndRun& run,
                                 Iteration now) const {
  const Interval interval{run.since, now};
  const bool changes[2] = {length_changes(a, interval), length_changes(b, interval)};
  if (changes[0] && changes[1] && interval.size() < kReadings) return true;
  for (const int which : {0, 1}) {
    const KeyPoint other = key_of(combination, which) == KeyPoint::left ? KeyPoint::right : KeyPoint::left;
    const auto firm = firm_.find({which == 0 ? a.id() : b.id(), other});
    if (changes[which] && firm != firm_.end() && firm->second + kFirmFor >= now) return true;
  }
  return false;
}

/// Which of the ends that stand still to each other are no key points.
void StaticPairs::judge_runs(const PlaneTrack& a, const PlaneTrack& b, PairHistory& pair) {
  const double sine = std::sin(radians(options_.parallel_deg));
  const bool parallel =
      std::abs(cross(a.find(pair.updated)->direction, b.find(pair.updated)->direction)) <= sine;
  for (int c = 0; c < 4; ++c) {
    EndRun& run = pair.run(c);
    run.undefined = parallel && run.since >= 0 && may_move_alike(a, b, c, run, pair.updated);
  }
  leave_one_end(a, b, options_.close_ratio, pair);
  if (parallel) return;
  for (const int which : {0, 1}) {
    for (const int end : {kEndA, kEndB}) {
      if (pair.still(which, end)) firm_[{which == 0 ? a.id() : b.id(), key_at(end)}] = pair.updated;
    }
  }
}

}  // namespace hallway::slam_plane::thesis
