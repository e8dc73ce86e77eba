// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// One matched pair: `reference` ~ T * `point`.
struct Pair {
  Vec3 reference = Vec3::Zero();  ///< frame a [m]
  Vec3 point = Vec3::Zero();      ///< frame b [m]
  double weight = 1.0;            ///< >= 0; n/(n+1) for a reference that averages n observations
};

/// What a fit must reach and what it may assume.
struct FitRules {
  bool planar = false;         ///< every z is 0: only x, y and yaw are unknown
  double min_spread_m2 = 0.0;  ///< see Alignment::solve
  double inlier_m = 0.0;       ///< residuals up to here count in full, larger ones as (inlier / residual)^2
};

/// T_a_b by re-weighted least squares from the guess `T`, which stays unchanged when the pairs do not determine it (false).
/// When all residuals are within inlier_m this is plain weighted least squares. O(pairs).
bool robust_fit(const std::vector<Pair>& pairs, const FitRules& rules, Pose& T);

}  // namespace hallway::slam_point
