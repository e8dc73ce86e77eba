// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <list>
#include <span>
#include <unordered_map>
#include <vector>

#include "slam_plane/thesis/comparison.hpp"
#include "slam_plane/thesis/pair_statistics.hpp"

namespace hallway::slam_plane::thesis {

/// Totals of a comparer.
struct CompareCounters {
  std::uint64_t comparisons = 0;  ///< made
  std::uint64_t hits = 0;         ///< of a pair whose statistics were at hand
  std::uint64_t discarded = 0;    ///< pairs forgotten for want of room
};

/// Compares tracks and keeps what it summed up, so that a new observation of a pair costs the same however many there were (thesis 5.3 item 1). The result has the same bits as that of
/// compare_uncached_in: all sums are exact. The pairs compared longest ago are forgotten when there are too many. Memory: 32 bytes a shared
/// observation and 352 a remembered interval, at most 56 KB for a pair with 1200; at most `max_pairs` of them.
class PairComparer {
 public:
  explicit PairComparer(const CompareOptions& options, std::size_t max_pairs = 1024);

  const CompareOptions& options() const { return options_; }

  /// b relative to a on an interval (Rule 19), from the ends that `combination` names: 2 * end of a + end of b. Observations of one iteration all have to be pushed before. O(1) a new observation,
  /// O(log n) a call.
  Comparison compare_in(const PlaneTrack& a, const PlaneTrack& b, const Interval& interval, int combination);

  /// The sums that are kept of two tracks, whatever the observations' sizes; a's name before b's. Good until another pair is asked for. O(1) a new observation.
  const PairStatistics& kept(const PlaneTrack& a, const PlaneTrack& b) { return statistics(a, b); }

  /// Rolls back: to be called with Track::truncate of all tracks, before anything is compared again. O(pairs + forgotten).
  void truncate(Iteration k);

  /// Forgets two tracks, because one's name will be given again or never used. O(log pairs).
  void forget(TrackId a, TrackId b);

  std::size_t pairs() const { return by_key_.size(); }
  const CompareCounters& counters() const { return counters_; }

 private:
  struct Entry {
    TrackPair key;
    PairStatistics statistics;
  };

  PairStatistics& statistics(const PlaneTrack& a, const PlaneTrack& b);

  CompareOptions options_;
  std::size_t max_pairs_;
  std::list<Entry> entries_;  // the one used last first
  std::unordered_map<TrackPair, std::list<Entry>::iterator, TrackPairHash> by_key_;
  CompareCounters counters_;
};

}  // namespace hallway::slam_plane::thesis
