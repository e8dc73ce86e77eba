// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "slam_plane/thesis/interval.hpp"
#include "slam_plane/thesis/ring_buffer.hpp"
#include "slam_plane/thesis/sighting.hpp"
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
  Interval interval;            ///< from first to last sighting in it
  Trend trend = Trend::steady;  ///< in it
  Iteration known_since = 0;    ///< iteration at which it was known to have begun
};

/// Everything observed of one wall: its sightings as they were, by iteration (thesis 4.2.1, 4.4.3.4). Only the newest `capacity` are kept. Memory: 144 bytes
/// a sighting, 175 KB for 1200 of them.
///
/// Matching, phases and sizes depend on nothing but the sightings pushed, so truncate(k) leaves what was there after iteration k (of what is still kept).
class Track {
 public:
  Track(TrackId id, const TrackOptions& options);

  TrackId id() const { return id_; }

  /// Adds a sighting of an iteration after newest().iteration. Throws std::invalid_argument otherwise. Amortized O(trend_window).
  void push(const Sighting& sighting);

  /// Rolls back: forgets the sightings after iteration k. @returns whether any are left. O(forgotten).
  bool truncate(Iteration k);

  /// Forgets all sightings for good and gives their memory back.
  void forget();

  std::size_t size() const { return sightings_.size(); }
  bool empty() const { return sightings_.empty(); }
  /// Sightings kept at most.
  std::size_t capacity() const { return sightings_.capacity(); }
  /// All sightings ever pushed, less those truncated.
  std::int64_t pushed() const { return pushed_; }
  /// The i-th that is kept, the oldest first.
  const Sighting& operator[](std::size_t i) const { return sightings_[i].sighting; }
  const Sighting& oldest() const { return sightings_.front().sighting; }
  const Sighting& newest() const { return sightings_.back().sighting; }
  /// The very first sighting, kept for ever: it aligns the map (Rule 4). Defined once something was pushed.
  const Sighting& first() const { return first_; }

  /// The sighting of an iteration, or null. O(log n).
  const Sighting* find(Iteration k) const;
  /// Index of the first sighting at k or later; size() if there is none. O(log n).
  std::size_t lower_bound(Iteration k) const;

  /// What was kept, split at gaps and where the plane turned, in the order of time. Never empty ones. O(1): they are kept up to date.
  const std::deque<Phase>& phases() const { return phases_; }
  /// The phase that contains an iteration, or null. O(log n).
  const Phase* phase_at(Iteration k) const;
  /// What was kept, split at gaps only: when the plane was visible. O(phases).
  Intervals visible() const;
  /// What it does now.
  Trend trend() const { return phases_.empty() ? Trend::steady : phases_.back().trend; }

  /// The largest lengths of the sightings in an interval. O(log n + n / 32 + 64).
  LargestLengths largest(const Interval& interval) const;

 private:
  struct Kept {
    Sighting sighting;
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
  Sighting first_;
  std::int64_t pushed_ = 0;  // number of the next sighting
  RingBuffer<Kept> sightings_;
  std::deque<Phase> phases_;
  std::deque<LargestLengths>
      blocks_;  // of sightings by number; the last one is not full, the first one perhaps too large
  std::int64_t first_block_ = 0;
};

/// The plane's size in an interval: the largest length that enough sightings back (Rules 18, 20), and the iterations whose
/// sightings are longer than that and take no part.
struct TrackSize {
  double size = 0.0;  ///< [m]; 0 if nothing was seen in the interval
  int outliers = 0;
  std::array<Iteration, LargestLengths::kKept> outlier{};  ///< the first `outliers` are set

  bool excludes(Iteration k) const;
};

/// From the largest lengths of the sightings in question.
TrackSize backed_size(const LargestLengths& largest, const CompareOptions& options);

/// Of a track's sightings in an interval. Complexity as Track::largest.
TrackSize size_in(const Track& track, const Interval& interval, const CompareOptions& options);

}  // namespace hallway::slam_plane::thesis
