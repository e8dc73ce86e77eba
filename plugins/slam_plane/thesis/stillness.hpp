// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <span>

#include "slam_plane/thesis/pair_statistics.hpp"

namespace hallway::slam_plane::thesis {

/// Standard deviations, differences and changes of length below it are none [m].
inline constexpr double kNoDeviation_m = 1e-4;
/// Shared observations that tell where there is no deviation at all.
inline constexpr int kExactReadings = 3;
/// Shared observations that tell otherwise.
inline constexpr int kReadings = 16;

/// Offset from an end of plane a to an end of plane b in one iteration, a laid on the x axis. `combination`: 2 * end of a + end of b.
Vec2 end_offset(const TimedObservation& a, const TimedObservation& b, int combination);

/// What an interval tells of two ends.
enum class Stillness {
  unknown,  ///< too little to tell
  still,
  moves,
};

/// The newest observations that two planes share, for all tests of intervals that end with them.
class NewestShared {
 public:
  static constexpr std::size_t kMost = 32;

  /// Up to an iteration; a's name before b's.
  NewestShared(const PlaneTrack& a, const PlaneTrack& b, Iteration last) : a_(a), b_(b), last_(last) {}

  const PlaneTrack& a() const { return a_; }
  const PlaneTrack& b() const { return b_; }
  Iteration last() const { return last_; }
  /// The offset between two ends at `last`, when both have to have been seen.
  Vec2 latest(int combination) const;
  /// Offsets between two ends, the newest first, of an iteration or later. They are computed when they are first asked for.
  std::span<const Vec2> offsets(int combination, Iteration first);

 private:
  void collect();

  const PlaneTrack& a_;
  const PlaneTrack& b_;
  Iteration last_;
  std::size_t count_ = 0;  // 0: they were not collected yet, or there are none
  std::array<const TimedObservation*, kMost> in_a_;
  std::array<const TimedObservation*, kMost> in_b_;
  std::array<std::array<Vec2, kMost>, 4> offsets_;  // by combination, where computed_ says so
  std::array<bool, 4> computed_{};
};

/// Judges the ends of two planes on one interval, from four parts of it (Rule 13). Two ends stand still where the mean of their offset differs from part to part by no more than its
/// deviation within the parts explains; that deviation is the noise, so nothing has to be known of it. To be believed, it has to be seen from places so far apart that an end which moves
/// by a tenth of the robot's way would have been noticed.
class StillnessTest {
 public:
  /// Sums up the interval from `first` to the newest observations. `newest` and `sums`, of the same two tracks, have to outlive it. O(log n).
  StillnessTest(NewestShared& newest, Iteration first, const PairStatistics& sums);

  std::int64_t count() const { return whole_.count; }
  OffsetMoments moments(int combination) const;
  /// O(log n).
  Stillness judge(int combination, double max_deviation_m);

 private:
  static constexpr std::size_t kParts = 4;
  static constexpr std::size_t kOutermost =
      3;  // newest and oldest observations that are looked at one by one

  /// What is looked at only where there is noise.
  struct Details {
    std::array<PairSums, kParts> parts;
    PairSums tail;                                             // the newest observations
    std::array<const TimedObservation*, kOutermost> oldest_a;  // the first `oldest` are set
    std::array<const TimedObservation*, kOutermost> oldest_b;
    std::size_t oldest;
  };

  void look_closer();
  bool drifts(int combination, const OffsetMoments& whole) const;
  bool wanders(int combination, const OffsetMoments& whole) const;
  double travel(int combination) const;

  NewestShared& newest_;
  Interval interval_;
  const PairStatistics& sums_;
  PairSums up_to_first_;  // what came before the interval
  PairSums up_to_last_;
  PairSums whole_;
  std::optional<Details> details_;
};

/// Whether a plane's length changes in an interval by more than it jumps from observation to observation: then one of its ends moves. O(log n).
bool length_changes(const PlaneTrack& track, const Interval& interval);

}  // namespace hallway::slam_plane::thesis
