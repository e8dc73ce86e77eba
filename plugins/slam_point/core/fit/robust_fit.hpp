// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// One matched pair: `reference` ~ T * `point`.
struct Pair {
  Vec3 reference = Vec3::Zero();  ///< frame a [m]
  Vec3 point = Vec3::Zero();      ///< frame b [m]
  double weight = 1.0;            ///< >= 0; see pair_weight()
  double quality = 1.0;  ///< Observation::weight of the point: its residual counts in units of its own noise
};

/// What a fit must reach and what it may assume.
struct FitRules {
  bool planar = false;         ///< every z is 0: only x, y and yaw are unknown
  double min_spread_m2 = 0.0;  ///< see Alignment::solve
  double inlier_m =
      0.0;  ///< residuals up to here, of a point of weight 1, count in full, larger ones as (inlier / residual)^2
};

/// Weight of a point of weight `point` beside a reference whose observations' weights sum to `reference`: what is left of
/// it when the reference's own noise is counted, too. n/(n+1) for a reference that averages n of weight 1.
inline double pair_weight(double reference, double point = 1.0) {
  return reference * point / (reference + point);
}

/// T_a_b by re-weighted least squares from the guess `T`, which stays unchanged when the pairs do not determine it (false).
/// When all residuals are within inlier_m this is plain weighted least squares. O(pairs).
bool robust_fit(const std::vector<Pair>& pairs, const FitRules& rules, Pose& T);

}  // namespace hallway::slam_point
