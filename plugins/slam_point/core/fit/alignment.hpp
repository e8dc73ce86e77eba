// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>

#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// exp of a rotation vector [rad] as a unit quaternion; exact zeros stay exact zeros. Unlike rotation_by() it takes no sine of small angles: it is in
/// innermost loops.
Quat rotation_exp(const Vec3& v);

/// Rotation vector [rad], length in [0, pi], of a unit quaternion. Unlike rotation_vector() it is exact near 0.
Vec3 rotation_log(const Quat& q);

/// What a fit must reach and what it may assume.
struct FitRules {
  bool planar = false;  ///< every z is 0: only x, y and yaw are unknown
  /// Least weighted sum of squared distances of the points from the worst axis of rotation [m^2]: below, the rotation is unobservable.
  double min_spread_m2 = 0.0;
  /// Robust fits: residuals up to here, of a point of weight 1, count in full, larger ones as (inlier / residual)^2 [m].
  double inlier_m = 0.0;

  /// The same where every pair counts in full.
  FitRules without_outliers() const {
    return {planar, min_spread_m2, std::numeric_limits<double>::infinity()};
  }
  /// Fewest pairs that determine a pose.
  std::size_t least_pairs() const { return planar ? 2 : 3; }
};

/// Weighted least-squares rigid alignment of matched points: the T_a_b that minimises sum w |a - T_a_b b|^2.
///
/// Pairs are summed once; the rotation is then found by Newton steps from a near guess (the relative motion of one
/// frame is small), which costs nothing per point. Sums are taken about the guess, so far-away maps lose no digits.
class Alignment {
 public:
  /// `guess` is T_a_b, within about 30 degrees of the answer.
  explicit Alignment(const Pose& guess) : guess_(guess) {}

  /// Adds the pair a ~ T_a_b * b with weight w >= 0 [1].
  [[gnu::always_inline]] void add(const Vec3& a, const Vec3& b, double w) {
    change(a, b, w);
    ++pairs_;
  }

  /// Changes the weight of a pair that was added by `w`, not below 0.
  [[gnu::always_inline]] void change(const Vec3& a, const Vec3& b, double w) {
    const Vec3 shifted = a - guess_.t;
    weight_ += w;
    const Vec3 wb = w * b;
    sum_a_ += w * shifted;
    sum_b_ += wb;
    add_outer(shifted, wb, cross_);
  }

  std::size_t pairs() const { return pairs_; }

  /// Solves. False when the pairs do not determine the pose: no weight, Newton does not converge, or their spread is below the least of
  /// `rules`. In planar data only the z axis counts.
  bool solve(const FitRules& rules, Pose& T_a_b) const;

 private:
  Pose guess_;
  double weight_ = 0.0;
  Vec3 sum_a_ = Vec3::Zero();
  Vec3 sum_b_ = Vec3::Zero();
  Mat3 cross_ = Mat3::Zero();
  std::size_t pairs_ = 0;
};

}  // namespace hallway::slam_point
