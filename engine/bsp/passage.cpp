// SPDX-License-Identifier: MIT
#include "bsp/passage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/box.hpp"

namespace hallway::bsp {
namespace {

constexpr double kOn_m = 1e-9;  ///< so near a plane a vertex counts as on it

/// A cell in metres.
struct CellShape {
  std::vector<Plane> planes;  ///< around it, normals outward
  std::vector<Vec3> corners;  ///< of it and of what borders on it
};

CellShape shape_of(const CellSpace& space, std::int32_t cell) {
  CellShape shape;
  std::vector<OrientedPlane> seen;
  for (const ExactPortal& portal : space.portals) {
    for (const std::size_t side : {0u, 1u}) {
      if (portal.region[side] != cell) continue;
      for (const FacetEdge& edge : portal.facet.edges)
        shape.corners.push_back(edge.start.at * space.metres_per_unit);
      const OrientedPlane plane{portal.facet.plane, side == 0};
      if (std::find(seen.begin(), seen.end(), plane) == seen.end()) seen.push_back(plane);
    }
  }
  for (const OrientedPlane& plane : seen) {
    shape.planes.push_back(space.planes.unit(plane));
    shape.planes.back().offset *= space.metres_per_unit;
  }
  return shape;
}

void cut_off(std::vector<Vec3>& vertices, const Plane& plane) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3& a = vertices[i];
    const Vec3& b = vertices[(i + 1) % vertices.size()];
    const double da = plane.distance(a);
    const double db = plane.distance(b);
    if (da <= 0.0) kept.push_back(a);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  vertices = std::move(kept);
}

/// What of a plane lies in the cell, around a point of the plane.
Polygon section(const Plane& plane, const Vec3& around, const std::vector<Plane>& cell) {
  constexpr double kFar_m = 1e6;
  const Vec3 u = kFar_m * plane.normal.unitOrthogonal();
  const Vec3 v = plane.normal.cross(u);
  Polygon polygon{{around - u - v, around + u - v, around + u + v, around - u + v}, plane};
  for (const Plane& side : cell) cut_off(polygon.vertices, side);
  return polygon;
}

/// -1 or 1 if all vertices lie on one side or on the plane and one does not; 0 for both sides or none.
int side_of(const Polygon& polygon, const Plane& plane) {
  bool front = false, back = false;
  for (const Vec3& vertex : polygon.vertices) {
    front = front || plane.distance(vertex) > kOn_m;
    back = back || plane.distance(vertex) < -kOn_m;
  }
  return front == back ? 0 : front ? 1 : -1;
}

bool is_solid(const CellSpace& space, const Vec3& at_m) {
  const std::uint32_t leaf = leaf_at(space.planes, space.tree, at_m / space.metres_per_unit);
  return space.tree.cells[space.tree.leaves[leaf].cell].label == Label::kSolid;
}

/// Whether there is solid beyond the edges that are as long as the section.
bool stands_in_solid(const CellSpace& space, const Polygon& cut, double width_m, double height_m) {
  for (std::size_t i = 0; i < cut.vertices.size(); ++i) {
    const Vec3& a = cut.vertices[i];
    const Vec3 along = cut.vertices[(i + 1) % cut.vertices.size()] - a;
    if (along.norm() < 0.5 * height_m) continue;
    const Vec3 outward = along.cross(cut.plane.normal).normalized();
    if (!is_solid(space, a + 0.5 * along + 0.1 * width_m * outward)) return false;
  }
  return true;
}

}  // namespace

std::pair<double, double> sides_of_rectangle(const std::vector<Polygon>& polygons) {
  std::pair<double, double> best{std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::infinity()};
  for (const Polygon& with_edge : polygons) {
    for (std::size_t i = 0; i < with_edge.vertices.size(); ++i) {
      const Vec3 edge = with_edge.vertices[(i + 1) % with_edge.vertices.size()] - with_edge.vertices[i];
      if (edge.norm() < kOn_m) continue;
      const Vec3 u = edge.normalized();
      const Vec3 v = with_edge.plane.normal.cross(u);
      Eigen::AlignedBox2d box;
      for (const Polygon& polygon : polygons) {
        for (const Vec3& vertex : polygon.vertices) box.extend(Vec2(u.dot(vertex), v.dot(vertex)));
      }
      const std::pair<double, double> sides = std::minmax({box.sizes().x(), box.sizes().y()});
      if (sides.first < best.first) best = sides;
    }
  }
  return best;
}

std::optional<Opening> narrowest_within(const CellSpace& space, const Passage& passage) {
  const CellShape cell = shape_of(space, passage.cell);
  std::optional<Opening> best;
  const auto try_plane = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 cross = (b - a).cross(c - a);
    if (cross.norm() < kOn_m * (b - a).norm()) return;
    const Vec3 normal = cross.normalized();
    const Plane plane{normal, normal.dot(a)};
    if (side_of(passage.from, plane) * side_of(passage.to, plane) >= 0) return;
    Polygon cut = section(plane, a, cell.planes);
    const auto [width_m, height_m] = sides_of_rectangle({cut});
    if (!std::isfinite(width_m) || width_m < kOn_m || (best && width_m >= best->width_m)) return;
    if (!stands_in_solid(space, cut, width_m, height_m)) return;
    const double before = std::abs(plane.distance(passage.from_at));
    const double behind = std::abs(plane.distance(passage.to_at));
    const double share = before / std::max(before + behind, kOn_m);
    best = Opening{passage.from_at + share * (passage.to_at - passage.from_at), width_m, height_m, {cut}};
  };
  for (const Polygon* portal : {&passage.from, &passage.to}) {
    for (std::size_t i = 0; i < portal->vertices.size(); ++i) {
      for (const Vec3& corner : cell.corners)
        try_plane(portal->vertices[i], portal->vertices[(i + 1) % portal->vertices.size()], corner);
    }
  }
  return best;
}

}  // namespace hallway::bsp
