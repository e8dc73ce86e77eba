// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// How bins are compared (thesis 6.5.3).
struct BinningRules {
  /// Bins whose last comparison joined them are compared first: the heuristic of figure 115. Else all take their turn.
  bool priority = true;
  /// One bin with more than this share of the points ends the comparisons of all with all; the rest is compared with it alone.
  double enough_share = 0.5;
  /// Above 0: two points are rigid against each other up to this deviation [m]. 0: found from the first round's deviations, sorted, as
  /// the last before a gap of more than `gap_m` and `gap_share` of itself.
  double threshold_m = 0.0;
  double gap_m = 0.02;     ///< [m]
  double gap_share = 1.0;  ///< [1]
  /// Where in the gap the threshold lies: 0 at its lower end, as in the thesis, which splits bins where few deviations were seen.
  double gap_place = 0.5;
};

/// Which points keep their distances.
struct BinningResult {
  std::vector<std::uint32_t> bin_of;  ///< by point; bins are named by the lowest point in them
  std::uint32_t largest = 0;          ///< the bin with the most points; of equal ones the lowest
  double threshold_m = 0.0;           ///< the one given, or the one found [m]
  std::uint64_t comparisons = 0;      ///< pairs whose deviation was asked for

  /// Whether a point belongs to the largest bin: the others move, or are noisier than the rest.
  bool stands(std::size_t point) const { return bin_of[point] == largest; }
};

/// Bins points by whether their distances stay the same, as the thesis finds moving points when a group is made: an approximation of
/// comparing all pairs, since one point of a bin speaks for all. Takes n - 1 comparisons when nothing moves and about n log n
/// up to the share that `enough_share` leaves; n (n - 1) / 2 at most. Deterministic.
///
/// @param deviation  standard deviation of the distance of two different points over the frames looked at [m]
BinningResult bin_points(std::size_t points, const BinningRules& rules,
                         const std::function<double(std::uint32_t, std::uint32_t)>& deviation);

/// The standard deviation of the distance of two points over frames that saw both; `a` and `b` have one place per frame, in the frame's own
/// coordinates [m]. 0 for fewer than two frames.
double distance_deviation(const std::vector<Vec3>& a, const std::vector<Vec3>& b);

}  // namespace hallway::slam_point
