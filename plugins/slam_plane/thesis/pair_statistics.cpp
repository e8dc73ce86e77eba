// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/pair_statistics.hpp"

#include <algorithm>
#include <limits>

#include "slam_plane/thesis/plane_track.hpp"

namespace hallway::slam_plane::thesis {
namespace {

constexpr int kStride = 8;              // shared observations from one checkpoint to the next
constexpr std::size_t kSummaries = 16;  // that are remembered
constexpr Iteration kBeforeAll = std::numeric_limits<Iteration>::min();

}  // namespace

PairStatistics::PairStatistics(std::size_t capacity)
    : checkpoints_(capacity / kStride + 2), updated_to_(kBeforeAll) {}

void PairStatistics::update(const PlaneTrack& a, const PlaneTrack& b) {
  if (a.empty() || b.empty()) return;
  const Iteration now = std::min(a.newest().iteration, b.newest().iteration);
  if (now > updated_to_) {
    for_each_shared(a, b, {updated_to_ + 1, now},
                    [&](const TimedObservation& in_a, const TimedObservation& in_b) {
                      total_ += sums_of(in_a, in_b);
                      if (++since_checkpoint_ < kStride) return;
                      checkpoints_.push_back({in_a.iteration, total_});
                      since_checkpoint_ = 0;
                    });
    updated_to_ = now;
  }
  const Iteration oldest = std::max(a.oldest().iteration, b.oldest().iteration);
  while (!checkpoints_.empty() && checkpoints_.front().iteration < oldest) checkpoints_.pop_front();
  const auto kept =
      std::ranges::find_if(summaries_, [&](const IntervalSummary& s) { return s.interval.first >= oldest; });
  summaries_.erase(summaries_.begin(), kept);
}

void PairStatistics::truncate(Iteration k) {
  if (updated_to_ <= k) return;
  while (!checkpoints_.empty() && checkpoints_.back().iteration > k) checkpoints_.pop_back();
  total_ = checkpoints_.empty() ? PairSums{} : checkpoints_.back().sums;
  updated_to_ = checkpoints_.empty() ? kBeforeAll : checkpoints_.back().iteration;
  since_checkpoint_ = 0;
  std::erase_if(summaries_, [k](const IntervalSummary& summary) { return summary.interval.last > k; });
}

std::size_t PairStatistics::first_checkpoint(Iteration k) const {
  return checkpoints_.partition_point(0, checkpoints_.size(),
                                      [k](const Checkpoint& at) { return at.iteration < k; });
}

PairSums PairStatistics::up_to(const PlaneTrack& a, const PlaneTrack& b, Iteration k) const {
  if (k >= updated_to_) return total_;
  PairSums between;
  const auto add = [&](const TimedObservation& in_a, const TimedObservation& in_b) {
    between += sums_of(in_a, in_b);
  };
  const std::size_t next = first_checkpoint(k + 1);
  const bool last = next == checkpoints_.size();
  const Iteration above = last ? updated_to_ : checkpoints_[next].iteration;
  if (next > 0 && k - checkpoints_[next - 1].iteration <= above - k) {
    for_each_shared(a, b, {checkpoints_[next - 1].iteration + 1, k}, add);
    between += checkpoints_[next - 1].sums;
    return between;
  }
  for_each_shared(a, b, {k + 1, above}, add);
  PairSums sums = last ? total_ : checkpoints_[next].sums;
  sums -= between;
  return sums;
}

PairSums PairStatistics::sums(const PlaneTrack& a, const PlaneTrack& b, const Interval& interval) const {
  if (interval.empty()) return {};
  PairSums sums = up_to(a, b, interval.last);
  sums -= up_to(a, b, interval.first - 1);
  return sums;
}

const IntervalSummary& PairStatistics::summary(const PlaneTrack& a, const PlaneTrack& b,
                                               const Interval& interval, const CompareOptions& options) {
  const auto at = std::ranges::lower_bound(summaries_, interval.first, {},
                                           [](const IntervalSummary& s) { return s.interval.first; });
  const bool known = at != summaries_.end() && at->interval.first == interval.first;
  if (known && at->interval.last == interval.last) return *at;
  newest_ = {interval, sums(a, b, interval), {size_in(a, interval, options), size_in(b, interval, options)}};
  exclude_outliers(a, b, newest_);
  if (interval.last > updated_to_) return newest_;  // more may come, so it is not remembered
  if (known) {
    *at = newest_;
  } else {
    summaries_.insert(at, newest_);
    if (summaries_.size() > kSummaries) summaries_.erase(summaries_.begin());
  }
  return newest_;
}

void PairStatistics::exclude_outliers(const PlaneTrack& a, const PlaneTrack& b, IntervalSummary& summary) {
  for (int t = 0; t < 2; ++t) {
    for (int i = 0; i < summary.size[t].outliers; ++i) {
      const Iteration k = summary.size[t].outlier[static_cast<std::size_t>(i)];
      if (t == 1 && summary.size[0].excludes(k)) continue;  // taken away already
      const TimedObservation* in_a = a.find(k);
      const TimedObservation* in_b = b.find(k);
      if (in_a != nullptr && in_b != nullptr) summary.sums -= sums_of(*in_a, *in_b);
    }
  }
}

}  // namespace hallway::slam_plane::thesis
