// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam_plane/thesis/pair_sums.hpp"
#include "slam_plane/thesis/sighting.hpp"
#include "slam_plane/thesis/track.hpp"
#include "slam_plane/thesis/track_options.hpp"

namespace hallway::slam_plane::thesis {

/// The end of a plane that is static while the other one may grow or shrink (Rules 13, 14).
enum class KeyPoint : unsigned char {
  none = 0,   ///< undetermined (Rule 15)
  left = 1,   ///< end a
  right = 2,  ///< end b
};

/// A plane in another one's frame, or in any other.
struct Placement {
  Vec2 middle = Vec2::Zero();       ///< estimated, at `size` [m]
  Vec2 direction = Vec2(1.0, 0.0);  ///< unit, from the left end to the right one
  double size = 0.0;                ///< [m]
  KeyPoint key =
      KeyPoint::none;  ///< of its ends the one that is known to be right if it is not at its full size
  Interval interval;   ///< on which size and key were found (Rule 19)
  bool valid = false;  ///< the rest is defined

  Segment segment() const;
};

/// What is summed up of a pair on one interval.
struct IntervalSummary {
  Interval interval;
  PairSums sums;      ///< of the iterations in which both were seen, with a credible size
  TrackSize size[2];  ///< of both on the interval
};

/// Where plane b lies relative to plane a, from all iterations of one interval in which both were seen (thesis 4.3.4, 4.4.3.6). In a's frame: a lies along the x axis, its left end first,
/// its estimated middle at the origin (Rule 3).
struct Comparison {
  bool valid =
      false;  ///< offset and direction can be used; else only interval, shared, size and deviations are defined
  Interval interval;                ///< on which it was made
  int shared = 0;                   ///< iterations in it that took part: both were seen, with a credible size
  Vec2 offset = Vec2::Zero();       ///< of b's estimated middle [m]
  Vec2 direction = Vec2(1.0, 0.0);  ///< of b, unit
  double size[2] = {
      0.0, 0.0};  ///< of a and b at which the middles were estimated: the largest in the interval [m]
  KeyPoint key[2] = {KeyPoint::none, KeyPoint::none};  ///< of a and b; both or none are determined
  bool parallel = false;                               ///< within CompareOptions::parallel_deg
  double deviation = 0.0;                              ///< of the offset, the least of `deviations` [m]
  std::array<double, 4>
      deviations{};  ///< standard deviations by (end of a, end of b): index 2 * end of a + end of b [m]

  bool has_keys() const { return valid && key[0] != KeyPoint::none; }
  /// Plane a (0) or b (1) in a's frame.
  Placement placement(int which) const;
};

/// The same the other way round: a relative to b, in b's frame.
Comparison inverse(const Comparison& comparison);

/// How many intervals of a pair are considered, the newest ones: so the cost of a comparison has a bound.
inline constexpr std::size_t kMaxIntervals = 32;

/// Intervals in which both planes were seen and neither turned from growing to shrinking or back (Rule 18), in the order of time, the newest kMaxIntervals of them. O(phases).
Intervals comparable_intervals(const Track& a, const Track& b);

/// Of several intervals the one to compare on: where both planes are largest; of those that are alike in that, the one with the most iterations (Rule 18), the latest one
/// of several. Null if there is none.
const IntervalSummary* best_summary(std::span<const IntervalSummary> summaries,
                                    const CompareOptions& options);

/// The comparison that a summary gives: rotation, then offset and key points from the combination of ends with the least deviation (Rules 3, 13, 14, 15). O(1).
Comparison evaluate(const IntervalSummary& summary, const CompareOptions& options);

/// Compares two tracks on the best interval, from the sightings themselves. The oracle of PairComparer::compare, which gives the same bits. The plane with the
/// smaller id is the one along x while summing; the result is turned round if that is b. O(n log n) in what is kept.
Comparison compare_uncached(const Track& a, const Track& b, const CompareOptions& options);

/// The same on a given interval, whatever happened in it (Rule 19).
Comparison compare_uncached_in(const Track& a, const Track& b, const Interval& interval,
                               const CompareOptions& options);

}  // namespace hallway::slam_plane::thesis
