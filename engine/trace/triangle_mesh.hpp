// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geom/polygon.hpp"

namespace hallway::trace {

/// Triangles that block sight: from both sides, whatever way round their vertices run. Metres, world frame.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`

  /// Appends a convex polygon as a fan around its first vertex; fewer than three vertices add nothing.
  void add_polygon(const Polygon& polygon);
};

}  // namespace hallway::trace
