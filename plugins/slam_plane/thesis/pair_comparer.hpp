// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <span>
#include <utility>
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
/// sighting and 352 a remembered interval, at most 56 KB for a pair with 1200; at most `max_pairs` of them.
class PairComparer {
 public:
  explicit PairComparer(const CompareOptions& options, std::size_t max_pairs = 1024);

  const CompareOptions& options() const { return options_; }

  /// b relative to a on an interval (Rule 19), from the ends that `combination` names: 2 * end of a + end of b. Sightings of one iteration all have to be pushed before. O(1) a new sighting,
  /// O(log n) a call.
  Comparison compare_in(const Track& a, const Track& b, const Interval& interval, int combination);

  /// What the shared sightings of an interval add up to, whatever their sizes; a's name before b's. O(log n).
  PairSums sums_in(const Track& a, const Track& b, const Interval& interval);

  /// Rolls back: to be called with Track::truncate of all tracks, before anything is compared again. O(pairs + forgotten).
  void truncate(Iteration k);

  /// Forgets all pairs with a track, because its name will be given again or never used.
  void forget(TrackId id);

  std::size_t pairs() const { return by_key_.size(); }
  const CompareCounters& counters() const { return counters_; }

 private:
  using Key = std::pair<TrackId, TrackId>;
  struct Entry {
    Key key;
    PairStatistics statistics;
  };

  PairStatistics& statistics(const Track& a, const Track& b);

  CompareOptions options_;
  std::size_t max_pairs_;
  std::list<Entry> entries_;  // the one used last first
  std::map<Key, std::list<Entry>::iterator> by_key_;
  CompareCounters counters_;
};

}  // namespace hallway::slam_plane::thesis
