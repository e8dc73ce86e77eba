// SPDX-License-Identifier: MIT
#include "em/core/plane_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hallway::em {
namespace {

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

PlaneFrame flat_frame(const Vec3& normal, const Vec3& origin) {
  // Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
  const double sign = std::copysign(1.0, normal.z());
  const double a = -1.0 / (sign + normal.z());
  const double b = normal.x() * normal.y() * a;
  PlaneFrame frame;
  frame.origin = origin;
  frame.normal = normal;
  frame.u = Vec3(1.0 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x());
  frame.v = Vec3(b, sign + normal.y() * normal.y() * a, -normal.y());
  return frame;
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

Footprint footprint_of(std::span<const Vec3> points, const Vec3& normal, const Vec3& origin) {
  Vec3 sum = Vec3::Zero();
  double squares = 0.0;
  for (const Vec3& p : points) {
    sum += p - origin;
    squares += std::pow(normal.dot(p - origin), 2);
  }
  const auto n = static_cast<double>(points.size());
  const Vec3 mean = sum / n;
  return {origin + mean - normal.dot(mean) * normal, std::sqrt(squares / n),
          outline_of(points, normal, origin)};
}

double density(double points, double area) {
  return area > 0.0 ? points / area : 0.0;
}

}  // namespace hallway::em
