// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/end_conflict.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kSigmas = 5.0;
constexpr double kLeast_m = 2e-3;

/// From the key point of a to that of b, in a's frame.
Vec2 between_keys(const Comparison& comparison) {
  const int a = comparison.key[0] == KeyPoint::right ? kEndB : kEndA;
  const int b = comparison.key[1] == KeyPoint::right ? kEndB : kEndA;
  return comparison.placement(1).segment().end[b] - comparison.placement(0).segment().end[a];
}

double variance_of_mean(const Comparison& comparison) {
  return comparison.deviation * comparison.deviation / std::max(1, comparison.shared);
}

}  // namespace

EndConflict conflict_between(const Comparison& older, const Comparison& newer) {
  EndConflict result;
  const Vec2 d = between_keys(newer) - between_keys(older);
  const double sigma = std::sqrt(variance_of_mean(older) + variance_of_mean(newer));
  if (d.norm() <= kLeast_m + kSigmas * sigma) return result;
  result.any = true;
  const double farther[2] = {newer.key[0] == KeyPoint::right ? -d.x() : d.x(),
                             d.dot(newer.direction) * (newer.key[1] == KeyPoint::right ? 1.0 : -1.0)};
  result.which = std::abs(farther[0]) > std::abs(farther[1]) ? 0 : 1;
  result.newer_right = farther[result.which] > 0.0;
  return result;
}

}  // namespace hallway::slam_plane::thesis
