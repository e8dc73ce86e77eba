// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/sighting.hpp"

#include <algorithm>

namespace hallway::slam_plane::spatial {

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

}  // namespace hallway::slam_plane::spatial
