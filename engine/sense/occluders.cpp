// SPDX-License-Identifier: MIT
#include "sense/occluders.hpp"

namespace hallway::sense {

trace::TriangleMesh make_occluders(const csg::Surface& surface, std::span<const trace::TriangleMesh> meshes) {
  trace::TriangleMesh all;
  all.vertices = surface.vertices;
  for (const csg::SurfacePolygon& polygon : surface.polygons) {
    const auto triangles = csg::triangulate(surface, polygon);
    all.triangles.insert(all.triangles.end(), triangles.begin(), triangles.end());
  }
  for (const trace::TriangleMesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& [a, b, c] : mesh.triangles) all.triangles.push_back({first + a, first + b, first + c});
  }
  return all;
}

}  // namespace hallway::sense
