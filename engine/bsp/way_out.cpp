// SPDX-License-Identifier: MIT
#include "bsp/way_out.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "bsp/passage.hpp"
#include "geom/box.hpp"

namespace hallway::bsp {
namespace {

constexpr std::uint32_t kNone = ~0u;

/// A portal's shape in metres.
Polygon polygon_of(const CellSpace& space, const ExactPortal& portal) {
  Polygon polygon;
  polygon.plane = space.planes.unit({portal.facet.plane, false});
  polygon.plane.offset *= space.metres_per_unit;
  for (const FacetEdge& edge : portal.facet.edges)
    polygon.vertices.push_back(edge.start.at * space.metres_per_unit);
  return polygon;
}

Vec3 middle_of(const CellSpace& space, const ExactPortal& portal) {
  Vec3 sum = Vec3::Zero();
  for (const FacetEdge& edge : portal.facet.edges) sum += edge.start.at;
  return sum * (space.metres_per_unit / static_cast<double>(portal.facet.edges.size()));
}

/// The point of a convex polygon nearest to a point of its plane.
Vec3 nearest_in(const Polygon& polygon, const Vec3& point) {
  const std::size_t n = polygon.vertices.size();
  bool inside = true;
  Vec3 best = polygon.vertices.front();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& a = polygon.vertices[i];
    const Vec3 along = polygon.vertices[(i + 1) % n] - a;
    if (polygon.plane.normal.cross(along).dot(point - a) < 0.0) inside = false;
    const double place = std::clamp(along.dot(point - a) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
    const Vec3 candidate = a + place * along;
    if ((candidate - point).squaredNorm() < (best - point).squaredNorm()) best = candidate;
  }
  return inside ? point : best;
}

/// Where a taut string from `a` to `b` would cross the polygon, nearly.
Vec3 crossing(const Polygon& polygon, const Vec3& a, const Vec3& b) {
  const double da = polygon.plane.distance(a);
  const double db = polygon.plane.distance(b);
  const double place = std::abs(da - db) < 1e-12 ? 0.5 : std::clamp(da / (da - db), 0.0, 1.0);
  const Vec3 point = a + place * (b - a);
  return nearest_in(polygon, point - polygon.plane.distance(point) * polygon.plane.normal);
}

/// Moves the points of a way within their portals until it is short.
void pull_tight(const std::vector<Polygon>& portals, std::vector<Vec3>& way) {
  constexpr int kRounds = 200;
  constexpr double kStill_m = 1e-5;
  for (int round = 0; round < kRounds; ++round) {
    double moved = 0.0;
    for (std::size_t i = 0; i < portals.size(); ++i) {
      // way[0] is the start and way[i + 1] the point in portal i; behind the last there is nothing to aim at.
      const bool last = i + 1 == portals.size();
      const Vec3 next = last ? way[i] : way[i + 2];
      const Vec3 point = crossing(portals[i], way[i], next);
      moved = std::max(moved, (point - way[i + 1]).norm());
      way[i + 1] = point;
    }
    if (moved < kStill_m) break;
  }
}

double length_of(const std::vector<Vec3>& way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
  return length;
}

/// Leaves out points that lie on the straight line between their neighbours.
std::vector<Vec3> without_straight_points(const std::vector<Vec3>& way) {
  constexpr double kStraight_m = 1e-4;
  std::vector<Vec3> out{way.front()};
  for (std::size_t i = 1; i + 1 < way.size(); ++i) {
    const Vec3 chord = way[i + 1] - out.back();
    const Vec3 offset = way[i] - out.back();
    if (offset.norm() < kStraight_m) continue;
    const double length = chord.norm();
    if (length > 0.0 && offset.cross(chord).norm() / length < kStraight_m && offset.dot(chord) > 0.0)
      continue;
    out.push_back(way[i]);
  }
  if (way.size() > 1) out.push_back(way.back());
  return out;
}

bool boxes_touch(const Polygon& a, const Polygon& b) {
  constexpr double kTouch_m = 1e-6;
  Box box_a, box_b;
  for (const Vec3& vertex : a.vertices) box_a.extend(vertex);
  for (const Vec3& vertex : b.vertices) box_b.extend(vertex);
  return ((box_a.min() - box_b.max()).array() <= kTouch_m).all() &&
         ((box_b.min() - box_a.max()).array() <= kTouch_m).all();
}

/// The open portals in the same plane that hang together with one.
std::vector<Polygon> opening_around(const CellSpace& space, const std::vector<bool>& open,
                                    std::uint32_t portal) {
  std::vector<Polygon> rest;
  for (std::uint32_t p = 0; p < space.portals.size(); ++p) {
    if (p != portal && open[p] && space.portals[p].facet.plane == space.portals[portal].facet.plane) {
      rest.push_back(polygon_of(space, space.portals[p]));
    }
  }
  std::vector<Polygon> found{polygon_of(space, space.portals[portal])};
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k < rest.size();) {
      if (boxes_touch(found[i], rest[k])) {
        found.push_back(std::move(rest[k]));
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
      } else {
        ++k;
      }
    }
  }
  return found;
}

}  // namespace

WaysOut::WaysOut(const CellSpace& space, const std::vector<bool>& open)
    : space_(space),
      open_(open),
      of_cell_(space.tree.cells.size()),
      middle_(space.portals.size(), Vec3::Zero()),
      best_(space.portals.size(), std::numeric_limits<double>::infinity()),
      next_(space.portals.size(), kNone) {
  using Entry =
      std::tuple<double, std::uint32_t, std::int32_t>;  // length to the void, portal, cell before it
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::uint32_t p = 0; p < space.portals.size(); ++p) {
    if (!open[p]) continue;
    const auto& [front, back] = space.portals[p].region;
    middle_[p] = middle_of(space, space.portals[p]);
    for (const std::int32_t cell : {front, back}) {
      if (cell != ExactPortal::kBeyond) of_cell_[static_cast<std::size_t>(cell)].push_back(p);
    }
    if (front != ExactPortal::kBeyond && back != ExactPortal::kBeyond) continue;
    best_[p] = 0.0;
    queue.emplace(0.0, p, std::max(front, back));
  }
  while (!queue.empty()) {
    const auto [length, portal, cell] = queue.top();
    queue.pop();
    if (length > best_[portal]) continue;
    for (const std::uint32_t p : of_cell_[static_cast<std::size_t>(cell)]) {
      const double there = length + (middle_[p] - middle_[portal]).norm();
      if (there >= best_[p]) continue;
      best_[p] = there;
      next_[p] = portal;
      const auto& region = space.portals[p].region;
      const std::int32_t before = region[0] == cell ? region[1] : region[0];
      if (before != ExactPortal::kBeyond) queue.emplace(there, p, before);
    }
  }
}

std::uint32_t WaysOut::first_portal(const Vec3& from_m, std::int32_t cell) const {
  std::uint32_t first = kNone;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t p : of_cell_[static_cast<std::size_t>(cell)]) {
    const double length = (middle_[p] - from_m).norm() + best_[p];
    if (length >= least) continue;
    least = length;
    first = p;
  }
  return first;
}

double WaysOut::length_m(const Vec3& from_m, std::int32_t cell) const {
  const std::uint32_t first = first_portal(from_m, cell);
  return first == kNone ? std::numeric_limits<double>::infinity()
                        : (middle_[first] - from_m).norm() + best_[first];
}

std::int32_t WaysOut::common_cell(std::uint32_t a, std::uint32_t b) const {
  const auto& of_a = space_.portals[a].region;
  const auto& of_b = space_.portals[b].region;
  const bool first = of_a[0] != ExactPortal::kBeyond && (of_a[0] == of_b[0] || of_a[0] == of_b[1]);
  return first ? of_a[0] : of_a[1];
}

void WaysOut::end_at_rim(const Vec3& from_m, std::int32_t cell, std::vector<std::uint32_t>& chain) const {
  Vec3 place = from_m;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const std::uint32_t rim = nearest_rim_portal(place, cell);
    if (rim != kNone) {
      chain.resize(i);
      chain.push_back(rim);
      return;
    }
    const auto& region = space_.portals[chain[i]].region;
    place = middle_[chain[i]];
    cell = region[0] == cell ? region[1] : region[0];
  }
}

std::uint32_t WaysOut::nearest_rim_portal(const Vec3& from_m, std::int32_t cell) const {
  std::uint32_t nearest = kNone;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t p : of_cell_[static_cast<std::size_t>(cell)]) {
    const auto& region = space_.portals[p].region;
    if (region[0] != ExactPortal::kBeyond && region[1] != ExactPortal::kBeyond) continue;
    const Polygon polygon = polygon_of(space_, space_.portals[p]);
    const double distance = (crossing(polygon, from_m, from_m) - from_m).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = p;
  }
  return nearest;
}

Leak WaysOut::find(const Vec3& from_m, std::int32_t cell) const {
  Leak leak;
  std::vector<std::uint32_t> chain;
  for (std::uint32_t p = first_portal(from_m, cell); p != kNone; p = next_[p]) chain.push_back(p);
  end_at_rim(from_m, cell, chain);
  std::vector<Polygon> polygons;
  std::vector<Vec3> way{from_m};
  for (const std::uint32_t p : chain) {
    polygons.push_back(polygon_of(space_, space_.portals[p]));
    way.push_back(middle_[p]);
  }
  pull_tight(polygons, way);
  constexpr double kNarrower = 0.99;  // a slanted cut is no better than the portal that it touches
  leak.narrowest.width_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const double portal_width = width(space_.planes, space_.portals[chain[i]].facet) * space_.metres_per_unit;
    if (portal_width >= leak.narrowest.width_m) continue;
    std::vector<Polygon> opening = opening_around(space_, open_, chain[i]);
    const auto [width_m, height_m] = sides_of_rectangle(opening);
    if (width_m >= leak.narrowest.width_m) continue;
    leak.narrowest = {way[i + 1], width_m, height_m, std::move(opening)};
  }
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Passage passage{common_cell(chain[i], chain[i + 1]), polygons[i], polygons[i + 1], way[i + 1],
                          way[i + 2]};
    const auto within = narrowest_within(space_, passage);
    if (within && within->width_m < kNarrower * leak.narrowest.width_m) leak.narrowest = *within;
  }
  leak.way = without_straight_points(way);
  leak.length_m = length_of(leak.way);
  return leak;
}

}  // namespace hallway::bsp
