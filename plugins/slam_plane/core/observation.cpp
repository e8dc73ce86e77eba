// SPDX-License-Identifier: MIT
#include "slam_plane/core/observation.hpp"

#include <algorithm>

namespace hallway::slam_plane {
namespace {

constexpr double kMaxCoordinate_m = 1e6;
constexpr double kLeastLength_m = 1e-3;

/// Written so that NaN fails.
bool may_be_wall(const WallObservation& seen) {
  return std::max(seen.a.cwiseAbs().maxCoeff(), seen.b.cwiseAbs().maxCoeff()) <= kMaxCoordinate_m &&
         seen.a.allFinite() && seen.b.allFinite() && cross(seen.a, seen.b) < 0.0;
}

}  // namespace

std::vector<AssociatedObservation> unassociated(std::span<const WallObservation> given) {
  std::vector<AssociatedObservation> observations;
  observations.reserve(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    const WallObservation& seen = given[i];
    if (!may_be_wall(seen)) continue;
    const double length = (seen.b - seen.a).norm();
    if (length < kLeastLength_m) continue;
    observations.push_back({.end = {seen.a, seen.b},
                            .middle = 0.5 * (seen.a + seen.b),
                            .direction = (seen.b - seen.a) / length,
                            .length = length,
                            .z_low = seen.z_low,
                            .z_high = seen.z_high,
                            .given = i});
  }
  return observations;
}

}  // namespace hallway::slam_plane
