// SPDX-License-Identifier: MIT
#include "trace/triangle_mesh.hpp"

namespace hallway::trace {

void TriangleMesh::add_polygon(const Polygon& polygon) {
  if (polygon.vertices.size() < 3) return;
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), polygon.vertices.begin(), polygon.vertices.end());
  const auto count = static_cast<std::uint32_t>(polygon.vertices.size());
  for (std::uint32_t i = 2; i < count; ++i) triangles.push_back({first, first + i - 1, first + i});
}

}  // namespace hallway::trace
