// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/LU>
#include <vector>

#include "slam_point/core/fit/robust_fit.hpp"
#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// What an observation counts for along the ray from the sensor to its point and across it, beside one whose coordinates all
/// have the standard deviation Options::noise_m: (noise_m / noise)^2.
struct RayWeight {
  double along = 1.0;   ///< above 0
  double across = 1.0;  ///< above 0
};

/// The information matrix of an observation, in units of 1 / noise_m^2: `ray` leads from the sensor to its point [m], in the
/// frame that the matrix is wanted in.
inline Mat3 ray_information(const Vec3& ray, const RayWeight& weight) {
  const double range2 = ray.squaredNorm();
  Mat3 information = weight.across * Mat3::Identity();
  if (range2 > 0.0) information += ((weight.along - weight.across) / range2) * ray * ray.transpose();
  return information;
}

/// Information on the distance of two points that are known independently: (a^-1 + b^-1)^-1, which pair_weight() is of numbers. One of the two
/// may be 0.
inline Mat3 pair_information(const Mat3& a, const Mat3& b) {
  return a * Mat3(a + b).inverse() * b;
}

/// [v]x: its product with a vector is the cross product.
Mat3 skew(const Vec3& v);

/// J_row^T information J_column for how points at y_row and y_column from the origins of two poses move with these: J = [I, -[y]x] for
/// (translation, rotation) of x = exp(rotation) y + t.
Mat6 motion_information(const Vec3& y_row, const Mat3& information, const Vec3& y_column);

/// One matched pair: `reference` ~ T * `point`, each with noise that differs by direction.
struct DirectionalPair {
  Vec3 reference = Vec3::Zero();  ///< frame a [m]
  Mat3 known = Mat3::Zero();      ///< information of the reference, frame a
  Vec3 point = Vec3::Zero();      ///< from the sensor, frame b [m]
  RayWeight weight{};             ///< of the point
  double plain_weight = 1.0;      ///< of the pair where directions are left aside; see pair_weight()
};

/// T_a_b of least squared distances in units of their noise, re-weighted as robust_fit() does (`rules.inlier_m` infinite: not at all),
/// from the guess `T`, which stays unchanged when the pairs do not determine it (false): when the rotation would be known
/// worse than one noise_m allows at `rules.min_spread_m2`. Gauss-Newton, begun where robust_fit() ends. O(pairs).
bool directional_fit(const std::vector<DirectionalPair>& pairs, const FitRules& rules, Pose& T);

}  // namespace hallway::slam_point
