// SPDX-License-Identifier: MIT
#include "bsp/way_out.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "bsp/opening_search.hpp"

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

/// The pieces of a way through a chain of portals. Where it follows an edge it is drawn a little into the open, so that what is asked about
/// its points is about space and not about surfaces.
std::vector<WayPiece> pieces_of(const std::vector<Vec3>& way, const std::vector<Vec3>& middles,
                                const std::vector<std::int32_t>& cells) {
  constexpr double kShare = 0.03, kMost_m = 0.05;
  std::vector<Vec3> points = way;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec3 inward = middles[i - 1] - points[i];
    const double length = inward.norm();
    if (length > 0.0) points[i] += std::min(kShare, kMost_m / length) * inward;
  }
  std::vector<WayPiece> pieces;
  for (std::size_t i = 0; i < cells.size(); ++i) pieces.push_back({points[i], points[i + 1], cells[i]});
  return pieces;
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
  std::vector<Vec3> way{from_m}, middles;
  std::vector<std::int32_t> cells;  // that the way is in before each portal
  for (const std::uint32_t p : chain) {
    polygons.push_back(polygon_of(space_, space_.portals[p]));
    way.push_back(middle_[p]);
    middles.push_back(middle_[p]);
    cells.push_back(cell);
    const auto& region = space_.portals[p].region;
    cell = region[0] == cell ? region[1] : region[0];
  }
  pull_tight(polygons, way);
  leak.narrowest = find_opening(EmptySpace(space_, open_), pieces_of(way, middles, cells));
  leak.way = without_straight_points(way);
  leak.length_m = length_of(leak.way);
  return leak;
}

}  // namespace hallway::bsp
