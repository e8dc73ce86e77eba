// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hallway::slam_plane::spatial {
namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(b - a, c - a);
}

/// One side of a hull, of points from left to right.
template <typename Points>
void add_chain(const Points& points, Polygon& hull) {
  const std::size_t first = hull.size();
  for (const Vec2& p : points) {
    while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
    hull.push_back(p);
  }
  hull.pop_back();  // the other chain begins with it
}

}  // namespace

PlaneAxes::PlaneAxes(const Vec3& normal) : n(normal) {
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  u = Vec3::Unit(least).cross(normal).normalized();
  v = normal.cross(u);
}

double area(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) twice += turn(polygon[0], polygon[i - 1], polygon[i]);
  return 0.5 * std::abs(twice);
}

Polygon convex_hull(std::vector<Vec2> points) {
  const auto before = [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Polygon hull;
  add_chain(points, hull);
  std::reverse(points.begin(), points.end());
  add_chain(points, hull);
  return hull;
}

Polygon clip(const Polygon& polygon, const Vec2& normal, double offset) {
  Polygon kept;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % n];
    const double da = normal.dot(a) - offset, db = normal.dot(b) - offset;
    if (da <= 0.0) kept.push_back(a);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

double overlap_area(const Polygon& a, const Polygon& b) {
  if (a.size() < 3 || b.size() < 3) return 0.0;
  Polygon both = a;
  for (std::size_t i = 0; i < b.size() && both.size() >= 3; ++i) {
    const Vec2& from = b[i];
    const Vec2 outward = -left_of(b[(i + 1) % b.size()] - from);
    both = clip(both, outward, outward.dot(from));
  }
  return area(both);
}

double width(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 run = polygon[(i + 1) % n] - polygon[i];
    if (run.norm() < std::numeric_limits<double>::min()) continue;
    double most = 0.0;
    for (const Vec2& p : polygon) most = std::max(most, std::abs(cross(run, p - polygon[i])) / run.norm());
    least = std::min(least, most);
  }
  return n < 3 ? 0.0 : least;
}

double distance(const Polygon& a, const Polygon& b) {
  if (overlap_area(a, b) > 0.0) return 0.0;
  double least = std::numeric_limits<double>::max();
  for (const auto& [corners, sides] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const std::size_t n = sides->size();
    for (const Vec2& p : *corners) {
      for (std::size_t i = 0; i < n; ++i) {
        const Vec2 &from = (*sides)[i], run = (*sides)[(i + 1) % n] - from;
        const double length2 = std::max(run.squaredNorm(), std::numeric_limits<double>::min());
        const double share = std::clamp(run.dot(p - from) / length2, 0.0, 1.0);
        least = std::min(least, (from + share * run - p).norm());
      }
    }
  }
  return least;
}

void simplify(Polygon& polygon, std::size_t most) {
  while (polygon.size() > std::max<std::size_t>(most, 3)) {
    const std::size_t n = polygon.size();
    std::size_t least = 0;
    double loss = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < n; ++i) {
      const double lost = std::abs(turn(polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]));
      if (lost < loss) {
        loss = lost;
        least = i;
      }
    }
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(least));
  }
}

std::vector<Vec2> flattened(std::span<const Vec3> points, const PlaneAxes& axes) {
  std::vector<Vec2> flat;
  flat.reserve(points.size());
  for (const Vec3& p : points) flat.push_back(axes.flat(p));
  return flat;
}

}  // namespace hallway::slam_plane::spatial
