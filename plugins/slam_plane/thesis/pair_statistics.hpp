// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "slam_plane/thesis/pair_sums.hpp"
#include "slam_plane/thesis/ring_buffer.hpp"
#include "slam_plane/thesis/track.hpp"

namespace hallway::slam_plane::thesis {

/// What is known of a pair on one interval.
struct IntervalSummary {
  Interval interval;
  int shared = 0;  ///< sightings that take part
  TrackSize size[2];
};

/// Running sums of one pair of tracks. Of every eighth shared sighting it keeps what all up to there add up to; so the sums on any interval come from two of those and at most
/// fourteen sightings, wherever the interval is split later, and a roll back only drops the newest.
class PairStatistics {
 public:
  explicit PairStatistics(std::size_t capacity);

  /// Takes in what was pushed to both since the last time. O(1) a new sighting.
  void update(const Track& a, const Track& b);

  /// Rolls back: forgets what came after iteration k. O(forgotten).
  void truncate(Iteration k);

  /// Sums over the shared sightings of an interval. O(log n).
  PairSums sums(const Track& a, const Track& b, const Interval& interval) const;

  /// Sizes and count on an interval; remembered until that changes.
  const IntervalSummary& summary(const Track& a, const Track& b, const Interval& interval,
                                 const CompareOptions& options);

 private:
  struct Checkpoint {
    Iteration iteration = 0;
    PairSums sums;  // of all shared sightings up to it
  };

  std::size_t first_checkpoint(Iteration k) const;

  RingBuffer<Checkpoint> checkpoints_;
  PairSums total_;
  Iteration updated_to_;
  Iteration last_shared_;
  int since_checkpoint_ = 0;
  std::vector<IntervalSummary> summaries_;  // in the order of time
};

}  // namespace hallway::slam_plane::thesis
