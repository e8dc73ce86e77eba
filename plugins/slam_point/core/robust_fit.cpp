// SPDX-License-Identifier: MIT
#include "slam_point/core/robust_fit.hpp"

#include "slam_point/core/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr int kMaxPasses = 8;

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
    Alignment next(fitted);
    bool outliers = false;
    const Mat3 rotation = fitted.q.toRotationMatrix();
    for (const Pair& pair : pairs) {
      const double r2 = pair.quality * (pair.reference - rotation * pair.point - fitted.t).squaredNorm();
      outliers = outliers || r2 > inlier2;
      next.add(pair.reference, pair.point, r2 > inlier2 ? pair.weight * inlier2 / r2 : pair.weight);
    }
    if (!outliers) break;
    if (!next.solve(rules.planar, rules.min_spread_m2, fitted)) return false;
  }
  T = fitted;
  return true;
}

}  // namespace hallway::slam_point
