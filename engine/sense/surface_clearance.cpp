// SPDX-License-Identifier: MIT
#include "sense/surface_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace hallway::sense {
namespace {

/// Polygons whose planes are the same but for rounding.
constexpr double kSamePlane_m = 1e-5;
constexpr double kSameDirection = 0.999;

constexpr double kOnPolygon_m =
    1e-4;  ///< slack of the search for polygons: a point of their plane may be off by rounding

std::vector<Box> boxes_of(const csg::Surface& surface) {
  std::vector<Box> boxes(surface.polygons.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const std::uint32_t vertex : surface.polygons[i].vertices) boxes[i].extend(surface.vertices[vertex]);
  }
  return boxes;
}

Box around(const Vec3& point, double distance) {
  return {Vec3(point.array() - distance), Vec3(point.array() + distance)};
}

double distance_to_segment(const Vec3& point, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double t = std::clamp(along.dot(point - from) / along.squaredNorm(), 0.0, 1.0);
  return (point - from - t * along).norm();
}

}  // namespace

SurfaceClearance::SurfaceClearance(const csg::Surface& surface)
    : surface_(surface), tree_(boxes_of(surface)) {
  for (std::uint32_t i = 0; i < surface.polygons.size(); ++i) {
    const auto& vertices = surface.polygons[i].vertices;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      edges_.push_back({vertices[k], vertices[(k + 1) % vertices.size()], i});
    }
  }
  std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.from, a.to, a.polygon) < std::tie(b.from, b.to, b.polygon);
  });
}

std::optional<std::uint32_t> SurfaceClearance::polygon_at(const Vec3& point, std::uint32_t solid,
                                                          std::uint32_t face) const {
  std::vector<std::uint32_t> near;
  tree_.find(around(point, kOnPolygon_m), near);
  for (const std::uint32_t i : near) {
    const csg::SurfacePolygon& polygon = surface_.polygons[i];
    if (polygon.solid == solid && polygon.face == face && holds(i, point)) return i;
  }
  return std::nullopt;
}

bool SurfaceClearance::is_clear(const Vec3& point, std::uint32_t polygon, double distance) const {
  const Vec3 above = point + distance * surface_.polygons[polygon].plane.normal;
  std::vector<std::uint32_t> near;
  tree_.find(around(point, 2.0 * distance + kOnPolygon_m), near);
  return std::all_of(near.begin(), near.end(), [&](std::uint32_t other) {
    return continues(polygon, other) ? clear_of_edges(point, other, distance)
                                     : clear_of_polygon(above, other, distance);
  });
}

bool SurfaceClearance::continues(std::uint32_t polygon, std::uint32_t other) const {
  const Plane& plane = surface_.polygons[polygon].plane;
  const csg::SurfacePolygon& next = surface_.polygons[other];
  return plane.normal.dot(next.plane.normal) > kSameDirection &&
         std::all_of(next.vertices.begin(), next.vertices.end(), [&](std::uint32_t vertex) {
           return std::abs(plane.distance(surface_.vertices[vertex])) <= kSamePlane_m;
         });
}

bool SurfaceClearance::is_seam(std::uint32_t polygon, std::uint32_t from, std::uint32_t to) const {
  const auto less = [](const Edge& a, const Edge& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
  };
  const auto [first, last] = std::equal_range(edges_.begin(), edges_.end(), Edge{to, from, 0}, less);
  return std::any_of(first, last, [&](const Edge& back) { return continues(polygon, back.polygon); });
}

bool SurfaceClearance::clear_of_edges(const Vec3& point, std::uint32_t polygon, double distance) const {
  const auto& vertices = surface_.polygons[polygon].vertices;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const std::uint32_t from = vertices[k];
    const std::uint32_t to = vertices[(k + 1) % vertices.size()];
    if (distance_to_segment(point, surface_.vertices[from], surface_.vertices[to]) < distance &&
        !is_seam(polygon, from, to)) {
      return false;
    }
  }
  return true;
}

bool SurfaceClearance::clear_of_polygon(const Vec3& point, std::uint32_t polygon, double distance) const {
  const csg::SurfacePolygon& other = surface_.polygons[polygon];
  const double height = other.plane.distance(point);
  if (std::abs(height) >= distance) return true;
  if (holds(polygon, point - height * other.plane.normal)) return false;
  for (std::size_t k = 0; k < other.vertices.size(); ++k) {
    const Vec3& from = surface_.vertices[other.vertices[k]];
    const Vec3& to = surface_.vertices[other.vertices[(k + 1) % other.vertices.size()]];
    if (distance_to_segment(point, from, to) < distance) return false;
  }
  return true;
}

/// By how many edges lie to one side, along the two axes that show the plane best. Where an edge passes is computed from
/// its lower end whichever way it runs, so a point beside an edge that two polygons share is in exactly one of them.
bool SurfaceClearance::holds(std::uint32_t polygon, const Vec3& point) const {
  const csg::SurfacePolygon& area = surface_.polygons[polygon];
  Eigen::Index drop = 0;
  area.plane.normal.cwiseAbs().maxCoeff(&drop);
  const Eigen::Index x = (drop + 1) % 3;
  const Eigen::Index y = (drop + 2) % 3;
  bool inside = false;
  for (std::size_t k = 0; k < area.vertices.size(); ++k) {
    const Vec3* low = &surface_.vertices[area.vertices[k]];
    const Vec3* high = &surface_.vertices[area.vertices[(k + 1) % area.vertices.size()]];
    if (((*low)[y] > point[y]) == ((*high)[y] > point[y])) continue;
    if ((*low)[y] > (*high)[y]) std::swap(low, high);
    const double side =
        ((*high)[x] - (*low)[x]) * (point[y] - (*low)[y]) - (point[x] - (*low)[x]) * ((*high)[y] - (*low)[y]);
    if (side > 0.0) inside = !inside;
  }
  return inside;
}

}  // namespace hallway::sense
