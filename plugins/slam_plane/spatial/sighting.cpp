// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/sighting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slam_plane/spatial/polygon.hpp"

namespace hallway::slam_plane::spatial {
namespace {

constexpr double kSliverSigmas = 4.0;  // of the distance between two edges

}  // namespace

Sighting sighting_of(const Face& face, std::size_t given) {
  Sighting sighting;
  sighting.given = given;
  sighting.normal = face.normal;
  sighting.centre = face.centre;
  sighting.outline = face.outline;
  const std::size_t n = face.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &a = face.outline[i], &b = face.outline[(i + 1) % n];
    sighting.reach_m = std::max(sighting.reach_m, (a - face.centre).norm());
    const Vec3 outward = (b - a).cross(face.normal);
    if (outward.norm() > 0.0) sighting.edges.push_back({{a, b}, outward.normalized(), false});
  }
  return sighting;
}

bool is_sliver(const Sighting& sighting, const Noise& noise) {
  const double sigma = std::numbers::sqrt2 * std::hypot(noise.end, noise.along);
  return width(flattened(sighting.outline, PlaneAxes(sighting.normal))) < kSliverSigmas * sigma;
}

}  // namespace hallway::slam_plane::spatial
