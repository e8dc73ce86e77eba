// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/observation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slam_plane/spatial/outline.hpp"

namespace hallway::slam_plane::spatial {
namespace {

constexpr double kSliverSigmas = 4.0;  // of the distance between two edges

}  // namespace

AssociatedObservation observation_of(const PlaneObservation& seen, std::size_t given) {
  AssociatedObservation observation;
  observation.given = given;
  observation.normal = seen.normal;
  observation.centre = seen.centre;
  observation.outline = seen.outline;
  const std::size_t n = seen.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &a = seen.outline[i], &b = seen.outline[(i + 1) % n];
    observation.reach_m = std::max(observation.reach_m, (a - seen.centre).norm());
    const Vec3 outward = (b - a).cross(seen.normal);
    if (outward.norm() > 0.0) observation.edges.push_back({{a, b}, outward.normalized(), false});
  }
  return observation;
}

void dissociate(std::vector<AssociatedObservation>& frame) {
  for (AssociatedObservation& observation : frame) {
    observation.landmark = kNone;
    observation.outlier = false;
  }
}

bool is_sliver(const AssociatedObservation& observation, const Noise& noise) {
  const double sigma = std::numbers::sqrt2 * std::hypot(noise.end, noise.along);
  return width(PlaneAxes(observation.normal).flat(observation.outline)) < kSliverSigmas * sigma;
}

}  // namespace hallway::slam_plane::spatial
