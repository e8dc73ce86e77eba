// SPDX-License-Identifier: MIT
#include "geometry/convex2.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hallway {
namespace {

bool before(const Vec2& a, const Vec2& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

/// Appends a point to a chain, from its place `first` on, that turns left at every corner.
void extend(Convex& chain, std::size_t first, const Vec2& p) {
  while (chain.size() >= first + 2 &&
         cross(chain.back() - chain[chain.size() - 2], p - chain[chain.size() - 2]) <= 0.0) {
    chain.pop_back();
  }
  chain.push_back(p);
}

/// Drops most of what is no corner before it is sorted: what lies within the polygon of the points outermost in eight directions (Akl and
/// Toussaint 1978).
void drop_inner(std::vector<Vec2>& points) {
  constexpr std::array<std::array<double, 2>, 8> kDirections{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  if (points.size() < 4 * kDirections.size()) return;
  std::array<Vec2, 8> outer;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const Vec2 direction(kDirections[i][0], kDirections[i][1]);
    outer[i] = *std::max_element(points.begin(), points.end(), [&](const Vec2& a, const Vec2& b) {
      return direction.dot(a) < direction.dot(b);
    });
  }
  if (outer[0] == outer[4] && outer[2] == outer[6]) return;  // all are the same
  std::erase_if(points, [&](const Vec2& p) {
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const Vec2& a = outer[i];
      const Vec2& b = outer[(i + 1) % outer.size()];
      if (a != b && cross(b - a, p - a) <= 0.0) return false;
    }
    return true;
  });
}

}  // namespace

PlaneAxes::PlaneAxes(const Vec3& normal) : n(normal) {
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  u = Vec3::Unit(least).cross(normal).normalized();
  v = normal.cross(u);
}

Convex PlaneAxes::flat(std::span<const Vec3> points) const {
  Convex flattened;
  flattened.reserve(points.size());
  for (const Vec3& p : points) flattened.push_back(flat(p));
  return flattened;
}

Convex PlaneAxes::flat(std::span<const Vec3> points, const Pose& T) const {
  Convex flattened;
  flattened.reserve(points.size());
  for (const Vec3& p : points) flattened.push_back(flat(T * p));
  return flattened;
}

std::vector<Vec3> PlaneAxes::lift(const Convex& polygon, double offset) const {
  std::vector<Vec3> lifted;
  for (const Vec2& p : polygon) lifted.push_back(lift(p, offset));
  return lifted;
}

Convex convex_hull(std::vector<Vec2> points) {
  drop_inner(points);
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Convex hull;
  for (const Vec2& p : points) extend(hull, 0, p);
  const std::size_t upper = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) extend(hull, upper, points[i]);
  hull.pop_back();
  return hull;
}

double polygon_area(std::span<const Vec2> polygon) {
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * twice;
}

double width(const Convex& polygon) {
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

Convex clip(const Convex& polygon, const Vec2& normal, double offset) {
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

}  // namespace hallway
