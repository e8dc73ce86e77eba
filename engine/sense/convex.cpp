// SPDX-License-Identifier: MIT
#include "sense/convex.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace hallway::sense {
namespace {

constexpr double kNothing_m2 = 1e-12;

Vec2 outward_of(const Convex& polygon, std::size_t edge) {
  const Vec2 way = polygon[(edge + 1) % polygon.size()] - polygon[edge];
  return Vec2(way.y(), -way.x());
}

/// One side of a hull, of points in order, without its last point.
void add_chain(const std::vector<Vec2>& points, Convex& hull) {
  const std::size_t first = hull.size();
  for (const Vec2& p : points) {
    while (hull.size() >= first + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
      hull.pop_back();
    hull.push_back(p);
  }
  hull.pop_back();
}

void drop_flat_corners(Convex& hull, double tolerance_m) {
  for (std::size_t i = 0; i < hull.size() && hull.size() > 3;) {
    const std::size_t n = hull.size();
    const Vec2 &before = hull[(i + n - 1) % n], &after = hull[(i + 1) % n];
    const Vec2 way = after - before;
    if (std::abs(cross(way, hull[i] - before)) < tolerance_m * way.norm()) {
      hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(i));
      i = i == 0 ? 0 : i - 1;
    } else {
      ++i;
    }
  }
}

}  // namespace

Convex hull_of(std::vector<Vec2> points, double tolerance_m) {
  std::ranges::sort(points, {}, [](const Vec2& p) { return std::pair(p.x(), p.y()); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  Convex hull;
  add_chain(points, hull);
  std::reverse(points.begin(), points.end());
  add_chain(points, hull);
  drop_flat_corners(hull, tolerance_m);
  return hull;
}

void subtract(std::vector<Convex>& pieces, const Convex& hole) {
  if (hole.size() < 3) return;
  std::vector<Convex> kept;
  for (Convex& piece : pieces) {
    Convex inside = piece;
    std::vector<Convex> outside;
    for (std::size_t i = 0; i < hole.size() && inside.size() >= 3; ++i) {
      const Vec2 outward = outward_of(hole, i);
      const double offset = outward.dot(hole[i]);
      Convex beyond = clip(inside, -outward, -offset);
      if (polygon_area(beyond) > kNothing_m2) outside.push_back(std::move(beyond));
      inside = clip(inside, outward, offset);
    }
    if (polygon_area(inside) <= kNothing_m2) {
      kept.push_back(std::move(piece));
    } else {
      for (Convex& part : outside) kept.push_back(std::move(part));
    }
  }
  pieces = std::move(kept);
}

}  // namespace hallway::sense
