// SPDX-License-Identifier: MIT
#include "slam_point/core/robust_fit.hpp"

#include "slam_point/core/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr int kMaxPasses = 8;

/// Whether a residual under T exceeds inlier2, each in units of its own noise.
bool has_outliers(const std::vector<Pair>& pairs, const Pose& T, double inlier2) {
  const Mat3 rotation = T.q.toRotationMatrix();
  for (const Pair& pair : pairs) {
    if (pair.quality * (pair.reference - rotation * pair.point - T.t).squaredNorm() > inlier2) return true;
  }
  return false;
}

}  // namespace

bool robust_fit(const std::vector<Pair>& pairs, const FitRules& rules, Pose& T) {
  const std::size_t least = rules.planar ? 2 : 3;
  if (pairs.size() < least) return false;
  const double inlier2 = rules.inlier_m * rules.inlier_m;
  Alignment first(T);
  for (const Pair& pair : pairs) first.add(pair.reference, pair.point, pair.weight);
  Pose fitted;
  if (!first.solve(rules.planar, rules.min_spread_m2, fitted)) return false;
  for (int pass = 1; pass < kMaxPasses; ++pass) {
    if (!has_outliers(pairs, fitted, inlier2)) break;
    Alignment next(fitted);
    const Mat3 rotation = fitted.q.toRotationMatrix();
    for (const Pair& pair : pairs) {
      const double r2 = pair.quality * (pair.reference - rotation * pair.point - fitted.t).squaredNorm();
      next.add(pair.reference, pair.point, r2 > inlier2 ? pair.weight * inlier2 / r2 : pair.weight);
    }
    if (!next.solve(rules.planar, rules.min_spread_m2, fitted)) return false;
  }
  T = fitted;
  return true;
}

}  // namespace hallway::slam_point
