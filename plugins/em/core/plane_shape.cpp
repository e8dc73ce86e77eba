// SPDX-License-Identifier: MIT
#include "em/core/plane_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hallway::em {
namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool before(const Vec2& a, const Vec2& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

// Appends a point to a chain that turns left at every corner.
void extend(std::vector<Vec2>& chain, std::size_t first, const Vec2& p) {
  while (chain.size() >= first + 2 &&
         cross(chain.back() - chain[chain.size() - 2], p - chain[chain.size() - 2]) <= 0.0) {
    chain.pop_back();
  }
  chain.push_back(p);
}

// Drops most of what is no corner before it is sorted: what lies within the polygon of the points outermost in eight directions (Akl and
// Toussaint 1978).
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

// The corner that lies farthest in a direction, searched onwards from `from`: the directions asked for turn with the edges.
std::size_t farthest(std::span<const Vec2> hull, const Vec2& direction, std::size_t from) {
  for (std::size_t steps = 0; steps < hull.size(); ++steps) {
    const std::size_t next = (from + 1) % hull.size();
    if (direction.dot(hull[next] - hull[from]) < 0.0) break;
    from = next;
  }
  return from;
}

// The rectangle between the lines through four corners of the hull.
Rectangle between(const Vec2& axis, double low_u, double high_u, double low_v, double high_v) {
  const Vec2 side(-axis.y(), axis.x());
  Rectangle box;
  box.axis = axis;
  box.half_u = 0.5 * (high_u - low_u);
  box.half_v = 0.5 * (high_v - low_v);
  box.centre = 0.5 * (low_u + high_u) * axis + 0.5 * (low_v + high_v) * side;
  if (box.half_v > box.half_u) {
    box.axis = side;
    std::swap(box.half_u, box.half_v);
  }
  return box;
}

Rectangle around_segment(const Vec2& a, const Vec2& b) {
  Rectangle box;
  box.centre = 0.5 * (a + b);
  box.half_u = 0.5 * (b - a).norm();
  if (box.half_u > 0.0) box.axis = (b - a).normalized();
  return box;
}

}  // namespace

Vec3 orient(const Vec3& normal, const Vec3& on_plane) {
  const double offset = normal.dot(on_plane);
  if (offset != 0.0) return offset > 0.0 ? Vec3(-normal) : normal;
  for (const double component : normal) {
    if (component != 0.0) return component < 0.0 ? Vec3(-normal) : normal;
  }
  return normal;
}

FlatFrame flat_frame(const Vec3& normal, const Vec3& origin) {
  // Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
  const double sign = std::copysign(1.0, normal.z());
  const double a = -1.0 / (sign + normal.z());
  const double b = normal.x() * normal.y() * a;
  FlatFrame frame;
  frame.origin = origin;
  frame.u = Vec3(1.0 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x());
  frame.v = Vec3(b, sign + normal.y() * normal.y() * a, -normal.y());
  return frame;
}

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  drop_inner(points);
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  for (const Vec2& p : points) extend(hull, 0, p);
  const std::size_t upper = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) extend(hull, upper, points[i]);
  hull.pop_back();
  return hull;
}

double polygon_area(std::span<const Vec2> polygon) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  return 0.5 * twice;
}

bool Rectangle::contains(const Vec2& p, double margin) const {
  const Vec2 d = p - centre;
  return std::abs(axis.dot(d)) <= half_u + margin && std::abs(side().dot(d)) <= half_v + margin;
}

std::array<Vec2, 4> Rectangle::corners() const {
  const Vec2 u = half_u * axis;
  const Vec2 v = half_v * side();
  return {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
}

Rectangle tightest_rectangle(std::span<const Vec2> hull) {
  if (hull.empty()) return {};
  if (hull.size() < 3) return around_segment(hull.front(), hull.back());
  Rectangle best;
  double least = std::numeric_limits<double>::infinity();
  std::size_t right = 0, far = 0, left = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 axis = (hull[(i + 1) % hull.size()] - hull[i]).normalized();
    const Vec2 side(-axis.y(), axis.x());
    right = farthest(hull, axis, i == 0 ? 0 : right);
    far = farthest(hull, side, i == 0 ? right : far);
    left = farthest(hull, -axis, i == 0 ? far : left);
    const Rectangle box =
        between(axis, axis.dot(hull[left]), axis.dot(hull[right]), side.dot(hull[i]), side.dot(hull[far]));
    if (box.area() < least) {
      least = box.area();
      best = box;
    }
  }
  return best;
}

Outline outline_of(std::span<const Vec3> points, const Vec3& normal, const Vec3& origin) {
  Outline outline;
  outline.frame = flat_frame(normal, origin);
  std::vector<Vec2> feet;
  feet.reserve(points.size());
  for (const Vec3& p : points) feet.push_back(outline.frame.flat(p));
  outline.hull = convex_hull(std::move(feet));
  outline.rectangle = tightest_rectangle(outline.hull);
  return outline;
}

std::array<Vec3, 4> corners_of(const Outline& outline) {
  std::array<Vec3, 4> corners;
  const std::array<Vec2, 4> flat = outline.rectangle.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = outline.frame.lift(flat[i]);
  return corners;
}

std::vector<Vec3> hull_of(const Outline& outline) {
  std::vector<Vec3> hull;
  hull.reserve(outline.hull.size());
  for (const Vec2& p : outline.hull) hull.push_back(outline.frame.lift(p));
  return hull;
}

double density(double points, double area) {
  return area > 0.0 ? points / area : 0.0;
}

}  // namespace hallway::em
