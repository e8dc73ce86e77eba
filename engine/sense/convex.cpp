// SPDX-License-Identifier: MIT
#include "sense/convex.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace hallway::sense {
namespace {

constexpr double kNothing_m2 = 1e-12;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

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

double area_of(const Convex& polygon) {
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * std::abs(twice);
}

double width_of(const Convex& polygon) {
  if (polygon.size() < 3) return 0.0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 outward = outward_of(polygon, i).normalized();
    double most = 0.0;
    for (const Vec2& p : polygon) most = std::max(most, -outward.dot(p - polygon[i]));
    least = std::min(least, most);
  }
  return least;
}

Convex hull_of(std::vector<Vec2> points, double tolerance_m) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  Convex hull;
  add_chain(points, hull);
  std::reverse(points.begin(), points.end());
  add_chain(points, hull);
  drop_flat_corners(hull, tolerance_m);
  return hull;
}

Convex cut(const Convex& polygon, const Vec2& normal, double offset) {
  Convex kept;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % n];
    const double da = normal.dot(a) - offset, db = normal.dot(b) - offset;
    if (da <= 0.0) kept.push_back(a);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
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
      Convex beyond = cut(inside, -outward, -offset);
      if (area_of(beyond) > kNothing_m2) outside.push_back(std::move(beyond));
      inside = cut(inside, outward, offset);
    }
    if (area_of(inside) <= kNothing_m2) {
      kept.push_back(std::move(piece));
    } else {
      for (Convex& part : outside) kept.push_back(std::move(part));
    }
  }
  pieces = std::move(kept);
}

}  // namespace hallway::sense
