// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "slam_plane/thesis/comparison.hpp"
#include "slam_plane/thesis/pair_sums.hpp"
#include "slam_plane/thesis/plane_track.hpp"
#include "slam_plane/thesis/ring_buffer.hpp"

namespace hallway::slam_plane::thesis {

/// Running sums of one pair of tracks. Of every eighth shared observation it keeps what all up to there add up to; so the sums on any interval come from two of those and at most
/// eight observations, wherever the interval is split later, and a roll back only drops the newest.
class PairStatistics {
 public:
  explicit PairStatistics(std::size_t capacity);

  /// Takes in what was pushed to both since the last time. O(1) a new observation.
  void update(const PlaneTrack& a, const PlaneTrack& b);

  /// Rolls back: forgets what came after iteration k. O(forgotten).
  void truncate(Iteration k);

  /// Sums over the shared observations up to iteration k, but for a constant that stays the same until the next update(): the difference of two is what lies between them. O(log n).
  PairSums up_to(const PlaneTrack& a, const PlaneTrack& b, Iteration k) const;

  /// Sums over the shared observations of an interval. O(log n).
  PairSums sums(const PlaneTrack& a, const PlaneTrack& b, const Interval& interval) const;

  /// Sums and sizes on an interval, less what is too long to be true (Rule 20); remembered until the interval changes. Valid until the next call of anything but sums(). O(log n), and Track::largest.
  const IntervalSummary& summary(const PlaneTrack& a, const PlaneTrack& b, const Interval& interval,
                                 const CompareOptions& options);

 private:
  struct Checkpoint {
    Iteration iteration = 0;
    PairSums sums;  // of all shared observations up to it
  };

  std::size_t first_checkpoint(Iteration k) const;
  static void exclude_outliers(const PlaneTrack& a, const PlaneTrack& b, IntervalSummary& summary);

  RingBuffer<Checkpoint> checkpoints_;
  PairSums total_;        // of all shared observations up to updated_to_
  Iteration updated_to_;  // all that was shared up to it is in
  int since_checkpoint_ = 0;
  IntervalSummary newest_;                  // made last
  std::vector<IntervalSummary> summaries_;  // by the interval's first iteration, one for each
};

}  // namespace hallway::slam_plane::thesis
