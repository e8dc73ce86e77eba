// SPDX-License-Identifier: MIT
#pragma once

#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// exp of a rotation vector [rad] as a unit quaternion; exact zeros stay exact zeros.
Eigen::Quaterniond rotation_exp(const Vec3& v);

/// Rotation vector [rad], length in [0, pi], of a unit quaternion.
Vec3 rotation_log(const Eigen::Quaterniond& q);

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

  int pairs() const { return pairs_; }

  /// Solves. False when the pairs do not determine the pose: no weight, Newton does not settle, or the weighted sum of
  /// squared distances [m^2] of the points from the worst axis of rotation is below `min_spread_m2`.
  /// In `planar` data (every z is 0) only the z axis counts.
  bool solve(bool planar, double min_spread_m2, Pose& T_a_b) const;

 private:
  Pose guess_;
  double weight_ = 0.0;
  Vec3 sum_a_ = Vec3::Zero();
  Vec3 sum_b_ = Vec3::Zero();
  Mat3 cross_ = Mat3::Zero();
  int pairs_ = 0;
};

}  // namespace hallway::slam_point
