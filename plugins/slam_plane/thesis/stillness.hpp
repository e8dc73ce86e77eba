// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/thesis/pair_comparer.hpp"

namespace hallway::slam_plane::thesis {

/// Standard deviations, differences and changes of length below it are none [m].
inline constexpr double kNoDeviation_m = 1e-4;
/// Shared sightings that tell where there is no deviation at all.
inline constexpr int kExactReadings = 3;
/// Shared sightings that tell otherwise.
inline constexpr int kReadings = 16;

/// Offset from an end of plane a to an end of plane b in one iteration, a laid on the x axis. `combination`: 2 * end of a + end of b.
Vec2 end_offset(const Sighting& a, const Sighting& b, int combination);

/// What an interval tells of two ends.
enum class Stillness {
  unknown,  ///< too little to tell
  still,
  moves,
};

/// Judges the ends of two planes on one interval, from four parts of it (Rule 13). Two ends stand still where the mean of their offset differs from part to part by no more than its
/// deviation within the parts explains; that deviation is the noise, so nothing has to be known of it. To be believed, it has to be seen from places so far apart that an end which moves
/// by a tenth of the robot's way would have been noticed.
class StillnessTest {
 public:
  /// Sums up the interval. a's name before b's. O(log n).
  StillnessTest(const Track& a, const Track& b, const Interval& interval, PairComparer& comparer);

  std::int64_t count() const { return whole_.count; }
  OffsetMoments moments(int combination) const;
  /// O(log n).
  Stillness judge(int combination, double max_deviation_m) const;

 private:
  static constexpr std::size_t kParts = 4;

  bool drifts(int combination, const OffsetMoments& whole) const;
  bool wanders(int combination, const OffsetMoments& whole) const;
  double travel(int combination) const;

  const Track& a_;
  const Track& b_;
  Interval interval_;
  PairSums whole_;
  std::array<PairSums, kParts> parts_;
  PairSums tail_;  // the newest sightings
};

/// Whether a plane's length changes in an interval by more than it jumps from sighting to sighting: then one of its ends moves. O(log n).
bool length_changes(const Track& track, const Interval& interval);

}  // namespace hallway::slam_plane::thesis
