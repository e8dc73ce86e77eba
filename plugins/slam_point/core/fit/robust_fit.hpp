// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {

/// One matched pair: `reference` ~ T * `point`.
struct Pair {
  Vec3 reference = Vec3::Zero();  ///< frame a [m]
  Vec3 point = Vec3::Zero();      ///< frame b [m]
  double weight = 1.0;            ///< >= 0; see pair_weight()
  double quality = 1.0;  ///< Observation::weight of the point: its residual counts in units of its own noise
};

/// Weight of a point of weight `point` beside a reference whose observations' weights sum to `reference`: what is left of
/// it when the reference's own noise is counted, too. n/(n+1) for a reference that averages n of weight 1.
inline double pair_weight(double reference, double point = 1.0) {
  return reference * point / (reference + point);
}

/// Rules for observations whose coordinates have this standard deviation: the rotation has to be known to 0.1 rad, and a residual beyond four
/// deviations loses weight.
inline FitRules fit_rules(double noise_m, bool planar) {
  // A rotation about an axis is known to noise / sqrt(sum of squared distances from the axis).
  const double spread = noise_m / 0.1;
  return {planar, spread * spread, 4.0 * noise_m};
}

/// T_a_b by re-weighted least squares from the guess `T`, which stays unchanged when the pairs do not determine it (false).
/// When all residuals are within inlier_m this is plain weighted least squares. O(pairs).
bool robust_fit(const std::vector<Pair>& pairs, const FitRules& rules, Pose& T);

}  // namespace hallway::slam_point
