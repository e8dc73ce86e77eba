// SPDX-License-Identifier: MIT
#include "bsp/empty_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "geom/box.hpp"

namespace hallway::bsp {
namespace {

constexpr double kOn_m = 1e-9;        ///< so near a plane a vertex counts as on it
constexpr double kThin_m2 = 1e-12;    ///< a smaller section is a touch
constexpr std::size_t kMost = 20000;  ///< cells that a section or ray passes; more count as the open

/// Removes what is in front of a plane.
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

/// A square in a plane that is larger than any map.
std::vector<Vec3> large_square(const Plane& plane, const Vec3& around) {
  constexpr double kFar_m = 1e6;
  const Vec3 u = kFar_m * plane.normal.unitOrthogonal();
  const Vec3 v = plane.normal.cross(u);
  return {around - u - v, around + u - v, around + u + v, around - u + v};
}

double area_of(const std::vector<Vec3>& vertices) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < vertices.size(); ++i)
    sum += (vertices[i - 1] - vertices[0]).cross(vertices[i] - vertices[0]);
  return 0.5 * sum.norm();
}

bool is_crossed(const std::vector<Vec3>& corners, const Plane& plane) {
  bool front = false, back = false;
  for (const Vec3& corner : corners) {
    const double distance = plane.distance(corner);
    front = front || distance > kOn_m;
    back = back || distance < -kOn_m;
  }
  return front && back;
}

/// Distance of a point of a convex polygon's plane to the polygon, at least; 0 within.
double outside_by(const std::vector<Vec3>& corners, const Vec3& normal, const Vec3& point) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 along = corners[(i + 1) % corners.size()] - corners[i];
    const double length = along.norm();
    if (length < kOn_m) continue;
    farthest = std::max(farthest, -normal.cross(along).dot(point - corners[i]) / length);
  }
  return farthest;
}

}  // namespace

EmptySpace::EmptySpace(const CellSpace& space, const std::vector<bool>& open)
    : space_(space), open_(open), of_cell_(space.tree.cells.size()) {
  corners_.reserve(space.portals.size());
  for (std::uint32_t p = 0; p < space.portals.size(); ++p) {
    const ExactPortal& portal = space.portals[p];
    std::vector<Vec3>& corners = corners_.emplace_back();
    for (const FacetEdge& edge : portal.facet.edges) corners.push_back(edge.start.at * space.metres_per_unit);
    for (const std::int32_t cell : portal.region) {
      if (cell != ExactPortal::kBeyond) of_cell_[static_cast<std::size_t>(cell)].push_back(p);
    }
  }
}

Plane EmptySpace::plane_of(std::uint32_t portal, std::int32_t cell) const {
  const ExactPortal& exact = space_.portals[portal];
  Plane plane = space_.planes.unit({exact.facet.plane, exact.region[0] == cell});
  plane.offset *= space_.metres_per_unit;
  return plane;
}

std::int32_t EmptySpace::beyond(std::uint32_t portal, std::int32_t cell) const {
  const auto& region = space_.portals[portal].region;
  return region[0] == cell ? region[1] : region[0];
}

void EmptySpace::clip_to_cell(std::int32_t cell, std::vector<Vec3>& vertices) const {
  std::uint32_t last = kNoPolygon;
  for (const std::uint32_t portal : of_cell_[static_cast<std::size_t>(cell)]) {
    const std::uint32_t plane = space_.portals[portal].facet.plane;
    if (plane != last) cut_off(vertices, plane_of(portal, cell));
    last = plane;
    if (vertices.empty()) return;
  }
}

std::optional<Section> EmptySpace::section(const Plane& plane, const Vec3& point, std::int32_t cell,
                                           double most_m2) const {
  constexpr double kIn_m = 1e-6;
  Section section{plane, 0.0, {}};
  std::vector<std::int32_t> cells{cell};
  std::set<std::int32_t> seen{cell};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::vector<Vec3> vertices = large_square(plane, point);
    clip_to_cell(cells[i], vertices);
    const double area = area_of(vertices);
    if (i == 0 && (area < kThin_m2 || outside_by(vertices, plane.normal, point) > kIn_m)) return std::nullopt;
    section.area_m2 += area;
    if (section.area_m2 > most_m2 || cells.size() > kMost) return std::nullopt;
    if (area >= kThin_m2) section.polygons.push_back({std::move(vertices), plane});
    for (const std::uint32_t portal : of_cell_[static_cast<std::size_t>(cells[i])]) {
      if (!open_[portal] || !is_crossed(corners_[portal], plane)) continue;
      const std::int32_t next = beyond(portal, cells[i]);
      if (next == ExactPortal::kBeyond) return std::nullopt;
      if (seen.insert(next).second) cells.push_back(next);
    }
  }
  return section;
}

std::optional<EmptySpace::Hit> EmptySpace::first_solid(const Vec3& from, std::int32_t cell,
                                                       const Vec3& direction) const {
  double gone = 0.0;
  for (std::size_t step = 0; step < kMost; ++step) {
    double exit = std::numeric_limits<double>::infinity();
    for (const std::uint32_t portal : of_cell_[static_cast<std::size_t>(cell)]) {
      const Plane plane = plane_of(portal, cell);
      const double speed = plane.normal.dot(direction);
      if (speed > kOn_m) exit = std::min(exit, std::max(-plane.distance(from) / speed, gone));
    }
    // Of the portals in the plane of the exit the one that the ray passes, or passes most nearly.
    std::optional<std::uint32_t> passed;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t portal : of_cell_[static_cast<std::size_t>(cell)]) {
      const Plane plane = plane_of(portal, cell);
      const Vec3 at = from + exit * direction;
      if (plane.normal.dot(direction) <= kOn_m || std::abs(plane.distance(at)) > 1e-7) continue;
      const Vec3& seen_from = space_.portals[portal].region[0] == cell ? -plane.normal : plane.normal;
      const double off = outside_by(corners_[portal], seen_from, at);
      if (off >= least) continue;
      least = off;
      passed = portal;
    }
    if (!passed) return std::nullopt;
    gone = exit;
    if (!open_[*passed]) return Hit{gone, Vec3(-plane_of(*passed, cell).normal)};
    cell = beyond(*passed, cell);
    if (cell == ExactPortal::kBeyond) return std::nullopt;
  }
  return std::nullopt;
}

std::vector<Plane> EmptySpace::planes_near(std::int32_t cell) const {
  std::vector<std::int32_t> cells{cell};
  for (const std::uint32_t portal : of_cell_[static_cast<std::size_t>(cell)]) {
    const std::int32_t next = beyond(portal, cell);
    if (!open_[portal] && next != ExactPortal::kBeyond) cells.push_back(next);
  }
  std::vector<std::pair<std::uint32_t, Plane>> found;
  for (const std::int32_t each : cells) {
    for (const std::uint32_t portal : of_cell_[static_cast<std::size_t>(each)])
      found.emplace_back(space_.portals[portal].facet.plane, plane_of(portal, each));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (i == 0 || found[i].first != found[i - 1].first) planes.push_back(found[i].second);
  }
  return planes;
}

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

}  // namespace hallway::bsp
