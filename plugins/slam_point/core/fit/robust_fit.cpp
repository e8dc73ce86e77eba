// SPDX-License-Identifier: MIT
#include "slam_point/core/fit/robust_fit.hpp"

#include <cmath>

namespace hallway::slam_point {
namespace {

constexpr int kMaxPasses = 8;
constexpr double kSettledWeight =
    1e-3;  // of all pairs together, where an observation that agrees has up to 1

/// Takes from pairs with residuals beyond inlier2 under T, in units of their own noise, what they count too much. Returns
/// the weight that was taken.
double lighten_outliers(const std::vector<Pair>& pairs, const Pose& T, double inlier2, Alignment& alignment) {
  const PointMotion motion(T);
  double taken = 0.0;
  for (const Pair& pair : pairs) {
    const double r2 = pair.quality * (pair.reference - motion * pair.point).squaredNorm();
    if (r2 <= inlier2) continue;
    const double excess = pair.weight * (1.0 - inlier2 / r2);
    alignment.change(pair.reference, pair.point, -excess);
    taken += excess;
  }
  return taken;
}

}  // namespace

bool robust_fit(const std::vector<Pair>& pairs, const FitRules& rules, Pose& T) {
  if (pairs.size() < rules.least_pairs()) return false;
  Alignment plain(T);
  for (const Pair& pair : pairs) plain.add(pair.reference, pair.point, pair.weight);
  Pose fitted;
  if (!plain.solve(rules, fitted)) return false;
  double taken = 0.0;
  for (int pass = 1; pass < kMaxPasses; ++pass) {
    Alignment next = plain;
    const double taken_before = taken;
    taken = lighten_outliers(pairs, fitted, rules.inlier_m * rules.inlier_m, next);
    if (std::abs(taken - taken_before) <= kSettledWeight) break;
    if (!next.solve(rules, fitted)) return false;
  }
  T = fitted;
  return true;
}

}  // namespace hallway::slam_point
