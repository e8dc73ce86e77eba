// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam_plane/thesis/observation.hpp"
#include "slam_plane/thesis/pair_sums.hpp"
#include "slam_plane/thesis/plane_track.hpp"
#include "slam_plane/thesis/track_options.hpp"

namespace hallway::slam_plane::thesis {

/// The end of a plane that is static while the other one may grow or shrink (Rules 13, 14).
enum class KeyPoint : unsigned char {
  none = 0,   ///< unobservable (Rule 15)
  left = 1,   ///< end a
  right = 2,  ///< end b
};

constexpr End end_of(KeyPoint key) {
  return key == KeyPoint::right ? kEndB : kEndA;
}
constexpr KeyPoint key_at(int end) {
  return end == kEndA ? KeyPoint::left : KeyPoint::right;
}

/// A plane in another one's frame, or in any other.
struct Placement {
  Vec2 middle = Vec2::Zero();       ///< estimated, at `size` [m]
  Vec2 direction = Vec2(1.0, 0.0);  ///< unit, from the left end to the right one
  double size = 0.0;                ///< [m]
  bool valid = false;               ///< the rest is defined

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
  KeyPoint key[2] = {KeyPoint::none, KeyPoint::none};  ///< of a and b: the ends that it was made from
  bool parallel = false;                               ///< within CompareOptions::parallel_deg
  double deviation = 0.0;                              ///< standard deviation of the offset [m]

  /// It tells where b lies, given where that end of a is. If b has no key point it is b's line alone that is told.
  bool places() const { return valid && key[0] != KeyPoint::none; }
  bool has_keys() const { return places() && key[1] != KeyPoint::none; }
  /// Whether both were made from the same ends of the planes.
  bool same_ends(const Comparison& other) const { return key[0] == other.key[0] && key[1] == other.key[1]; }
  /// Plane a (0) or b (1) in a's frame.
  Placement placement(int which) const;
};

/// The key points of a combination of ends: 2 * end of a + end of b.
constexpr KeyPoint key_of(int combination, int which) {
  return key_at(which == 0 ? combination / 2 : combination % 2);
}

/// The same combination from the other plane's view: of b and a.
constexpr int turned_round(int combination) {
  return 2 * (combination % 2) + combination / 2;
}

/// The same the other way round: a relative to b, in b's frame.
Comparison inverse(const Comparison& comparison);

/// The comparison of a summary from the ends that `combination` names, 2 * end of a + end of b: rotation first, then the offset of the middles that these ends estimate (Rules 3, 13, 14). O(1).
Comparison evaluate(const IntervalSummary& summary, int combination, const CompareOptions& options);

/// Compares two tracks on an interval, whatever happened in it (Rule 19), from the observations themselves. The oracle of PairComparer::compare_in, which gives the same bits. The plane with the
/// smaller id is the one along x while summing; the result is turned round if that is b. O(n).
Comparison compare_uncached_in(const PlaneTrack& a, const PlaneTrack& b, const Interval& interval,
                               int combination, const CompareOptions& options);

/// Two comparisons of the same ends of two planes that tell different offsets: one of them took an end for a corner that is none.
struct EndConflict {
  bool any = false;  ///< they differ by more than their standard deviations explain
  int which = 0;     ///< plane a (0) or b (1), whose end it is
  bool newer_right =
      false;  ///< in the newer one the plane reaches farther. It cannot be seen where it is not, so the other one is wrong (Rule 18: the largest size counts)
};

/// Compares two comparisons with key points of the same ends. O(1).
EndConflict conflict_between(const Comparison& older, const Comparison& newer);

/// Where plane b's line lies relative to an end of plane a, from the newest shared observations: of a plane that is cut on both sides nothing else can be told. Valid if the end's distance from
/// that line stood still, judged by how it jumps from observation to observation. It has no key point of b. O(1): of at most 64 iterations.
Comparison compare_line(const PlaneTrack& a, const PlaneTrack& b, int end_of_a, Iteration now,
                        const CompareOptions& options);

}  // namespace hallway::slam_plane::thesis
