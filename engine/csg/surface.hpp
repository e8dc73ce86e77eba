// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "csg/boundary.hpp"
#include "geom/plane.hpp"
#include "map/world.hpp"

namespace hallway::csg {

/// A convex piece of the world's surface.
struct SurfacePolygon {
  Plane plane;  ///< metres; the normal points from the solid into the empty side
  /// Indices into Surface::vertices, counter-clockwise as seen from the empty side. Consecutive edges may be collinear:
  /// every vertex of a neighbour that lies on an edge is a vertex of the polygon (there are no T-junctions).
  std::vector<std::uint32_t> vertices;
  std::uint32_t solid = 0;  ///< index in map::World::solids of the brush that it comes from
  std::uint32_t face = 0;   ///< index in Solid::faces of that brush
};

/// The boundary between solid and empty: closed, oriented, without interior faces.
struct Surface {
  std::vector<Vec3> vertices;  ///< metres, world frame; no two are the same
  std::vector<SurfacePolygon> polygons;
};

/// Corners closer than this become one vertex, and a vertex this close to an edge is on it; map units.
inline constexpr double kWeldDistance = 2e-6;

/// The boundary in metres: polygon i is facet i (pieces thinner than kWeldDistance have no vertices left and are polygons without
/// vertices). O(n log n).
Surface make_surface(const ExactBrushes& brushes, const std::vector<BoundaryFacet>& facets,
                     double metres_per_unit);

/// The surface of a world, detail included: make_exact(), boundary() and make_surface() in one.
Surface build_surface(const map::World& world);

/// The triangles of a polygon as indices into Surface::vertices, with its orientation; none has all three vertices on a
/// line, and every edge of the polygon is an edge of one of them. O(n^2) in its vertices.
std::vector<std::array<std::uint32_t, 3>> triangulate(const Surface& surface, const SurfacePolygon& polygon);

}  // namespace hallway::csg
