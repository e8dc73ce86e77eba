// SPDX-License-Identifier: MIT
#include "csg/surface.hpp"

#include <algorithm>
#include <cmath>

#include "csg/t_junctions.hpp"
#include "csg/welder.hpp"

namespace hallway::csg {
namespace {

std::vector<std::uint32_t> loop_of(const BoundaryFacet& facet, Welder& welder) {
  std::vector<std::uint32_t> loop;
  loop.reserve(facet.facet.edges.size());
  for (const FacetEdge& edge : facet.facet.edges) loop.push_back(welder.number_of(edge.start.at));
  if (facet.flipped) std::reverse(loop.begin(), loop.end());
  return loop;
}

/// Leaves out the vertices that no polygon uses.
void compact(Surface& surface) {
  constexpr std::uint32_t kUnused = ~0u;
  std::vector<std::uint32_t> number(surface.vertices.size(), kUnused);
  std::vector<Vec3> used;
  for (SurfacePolygon& polygon : surface.polygons) {
    for (std::uint32_t& vertex : polygon.vertices) {
      if (number[vertex] == kUnused) {
        number[vertex] = static_cast<std::uint32_t>(used.size());
        used.push_back(surface.vertices[vertex]);
      }
      vertex = number[vertex];
    }
  }
  surface.vertices = std::move(used);
}

/// A measure of how good the triangle at a corner is: its area over the square of its longest side; 0 on a line.
double quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  const double area = (b - a).cross(c - a).dot(normal);
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return area / longest;
}

}  // namespace

Surface make_surface(const ExactBrushes& brushes, const std::vector<BoundaryFacet>& facets,
                     double metres_per_unit) {
  Welder welder(kWeldDistance);
  std::vector<std::vector<std::uint32_t>> loops;
  loops.reserve(facets.size());
  for (const BoundaryFacet& facet : facets) loops.push_back(loop_of(facet, welder));
  resolve_t_junctions(welder.points(), kWeldDistance, loops);
  Surface surface;
  surface.vertices.reserve(welder.points().size());
  for (const Vec3& point : welder.points()) surface.vertices.push_back(point * metres_per_unit);
  surface.polygons.reserve(facets.size());
  for (std::size_t i = 0; i < facets.size(); ++i) {
    SurfacePolygon polygon;
    polygon.plane = brushes.planes.unit({facets[i].facet.plane, facets[i].flipped});
    polygon.plane.offset *= metres_per_unit;
    polygon.vertices = std::move(loops[i]);
    polygon.solid = facets[i].solid;
    polygon.face = facets[i].face;
    surface.polygons.push_back(std::move(polygon));
  }
  compact(surface);
  return surface;
}

Surface build_surface(const map::World& world) {
  const ExactBrushes brushes = make_exact(world);
  return make_surface(brushes, boundary(brushes, Parts::kAll), world.metres_per_unit);
}

std::vector<std::array<std::uint32_t, 3>> triangulate(const Surface& surface, const SurfacePolygon& polygon) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> loop = polygon.vertices;
  const auto at = [&](std::size_t i) -> const Vec3& { return surface.vertices[loop[i % loop.size()]]; };
  const Vec3& normal = polygon.plane.normal;
  while (loop.size() >= 3) {
    // The best ear whose removal does not leave a line.
    const std::size_t n = loop.size();
    std::size_t best = n;
    double best_quality = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double value = quality(at(i + n - 1), at(i), at(i + 1), normal);
      if (value <= best_quality) continue;
      double rest = n == 3 ? 1.0 : 0.0;  // area of the fan that is left
      for (std::size_t k = 2; k + 1 < n && rest < 1e-12; ++k) {
        rest = std::max(rest, quality(at(i + 1), at(i + k), at(i + k + 1), normal));
      }
      if (rest < 1e-12) continue;
      best = i;
      best_quality = value;
    }
    if (best == n) break;
    triangles.push_back({loop[(best + n - 1) % n], loop[best], loop[(best + 1) % n]});
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return triangles;
}

}  // namespace hallway::csg
