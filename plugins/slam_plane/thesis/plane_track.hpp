// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "slam_plane/thesis/interval.hpp"
#include "slam_plane/thesis/observation.hpp"
#include "slam_plane/thesis/ring_buffer.hpp"
#include "slam_plane/thesis/size_filter.hpp"
#include "slam_plane/thesis/track_options.hpp"
#include "slam_plane/thesis/trend.hpp"

namespace hallway::slam_plane::thesis {

/// A track's place in the book of tracks; those of tracks that are no more are given again.
using TrackId = std::uint64_t;

/// Two tracks, the one with the smaller name first.
using TrackPair = std::pair<TrackId, TrackId>;

/// For tables that are looked up by two tracks.
struct TrackPairHash {
  std::size_t operator()(const TrackPair& pair) const {
    std::uint64_t h = (pair.first * 0x9e3779b97f4a7c15u) ^ (pair.second + 0x7f4a7c15u);  // Fibonacci hashing
    h *= 0xff51afd7ed558ccdu;
    return static_cast<std::size_t>(h ^ (h >> 32));
  }
};

/// Iterations in which a plane was seen without a gap and did not turn from growing to shrinking or back: in all of them one end at least is static (Rule 18).
struct Phase {
  Interval interval;            ///< from first to last observation in it
  Trend trend = Trend::steady;  ///< in it
  Iteration known_since = 0;    ///< iteration at which it was known to have begun
};

/// Everything observed of one wall: its observations as they were, by iteration (thesis 4.2.1, 4.4.3.4). Only the newest `capacity` are kept. Memory: 144 bytes
/// an observation, 175 KB for 1200 of them.
///
/// Matching, phases and sizes depend on nothing but the observations pushed, so truncate(k) leaves what was there after iteration k (of what is still kept).
class PlaneTrack {
 public:
  PlaneTrack(TrackId id, const TrackOptions& options);

  TrackId id() const { return id_; }

  /// Adds an observation of an iteration after newest().iteration. Throws std::invalid_argument otherwise. Amortized O(trend_window).
  void push(const TimedObservation& observation);

  /// Rolls back: forgets the observations after iteration k. @returns whether any are left. O(forgotten).
  bool truncate(Iteration k);

  /// Forgets all observations for good and gives their memory back.
  void forget();

  std::size_t size() const { return observations_.size(); }
  bool empty() const { return observations_.empty(); }
  /// Observations kept at most.
  std::size_t capacity() const { return observations_.capacity(); }
  /// All observations ever pushed, less those truncated.
  std::int64_t pushed() const { return pushed_; }
  /// The i-th that is kept, the oldest first.
  const TimedObservation& operator[](std::size_t i) const { return observations_[i].observation; }
  const TimedObservation& oldest() const { return observations_.front().observation; }
  const TimedObservation& newest() const { return observations_.back().observation; }
  /// The very first observation, kept for ever: it aligns the map (Rule 4). Defined once something was pushed.
  const TimedObservation& first() const { return first_; }

  /// The observation of an iteration, or null. O(log n).
  const TimedObservation* find(Iteration k) const;
  /// Index of the first observation at k or later; size() if there is none. O(log n).
  std::size_t lower_bound(Iteration k) const;

  /// What was kept, split at gaps and where the plane turned, in the order of time. Never empty ones. O(1): they are kept up to date.
  const std::deque<Phase>& phases() const { return phases_; }
  /// What was kept, split at gaps only: when the plane was visible. O(phases).
  Intervals visible() const;
  /// What it does now.
  Trend trend() const { return phases_.empty() ? Trend::steady : phases_.back().trend; }

  /// The largest lengths of the observations in an interval. O(log n + n / 32 + 64).
  LargestLengths largest(const Interval& interval) const;

 private:
  struct Kept {
    TimedObservation observation;
    TrendDetector detector;   // after it
    Iteration run_first = 0;  // where the interval without a gap began
  };

  void watch_trend();
  void split(Iteration end);
  void index_newest();
  void truncate_index();
  void drop_oldest();

  TrackId id_;
  TrackOptions options_;
  TimedObservation first_;
  std::int64_t pushed_ = 0;  // number of the next observation
  RingBuffer<Kept> observations_;
  std::deque<Phase> phases_;
  std::deque<LargestLengths>
      blocks_;  // of observations by number; the last one is not full, the first one perhaps too large
  std::int64_t first_block_ = 0;
};

/// The plane's size in an interval: the largest length that enough observations back (Rules 18, 20), and the iterations whose
/// observations are longer than that and take no part.
struct TrackSize {
  double size = 0.0;  ///< [m]; 0 if nothing was seen in the interval
  int outliers = 0;
  std::array<Iteration, LargestLengths::kKept> outlier{};  ///< the first `outliers` are set

  bool excludes(Iteration k) const;
};

/// From the largest lengths of the observations in question.
TrackSize backed_size(const LargestLengths& largest, const CompareOptions& options);

/// Of a track's observations in an interval. Complexity as Track::largest.
TrackSize size_in(const PlaneTrack& track, const Interval& interval, const CompareOptions& options);

/// Calls `visit(observation of a, observation of b)` for each iteration of an interval in which both were seen, in the order of time: planes are never compared across
/// iterations (Rule 2). O(log n + observations of both in the interval).
template <typename Visit>
void for_each_shared(const PlaneTrack& a, const PlaneTrack& b, const Interval& interval, const Visit& visit) {
  std::size_t i = a.lower_bound(interval.first);
  std::size_t j = b.lower_bound(interval.first);
  while (i < a.size() && j < b.size()) {
    const TimedObservation& in_a = a[i];
    const TimedObservation& in_b = b[j];
    if (in_a.iteration > interval.last || in_b.iteration > interval.last) return;
    if (in_a.iteration == in_b.iteration) visit(in_a, in_b);
    if (in_a.iteration <= in_b.iteration) ++i;
    if (in_b.iteration <= in_a.iteration) ++j;
  }
}

}  // namespace hallway::slam_plane::thesis
