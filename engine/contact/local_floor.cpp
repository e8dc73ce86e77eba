// SPDX-License-Identifier: MIT
#include "contact/local_floor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hallway::contact {
namespace {

/// Bodies are larger by this than they are, metres: what floors that are flat within FloorBands::flat do to them.
constexpr double kMargin = 1e-3;
/// An area that is covered but for less is covered, square metres.
constexpr double kSpeck = 1e-8;
/// Remainders of an area, beyond which it counts as not covered.
constexpr std::size_t kMostPieces = 64;

using Corners = std::vector<Vec3>;

/// What of a convex polygon has sign * point[axis] <= limit.
Corners cut(const Corners& polygon, Eigen::Index axis, double sign, double limit) {
  Corners kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = sign * a[axis] - limit, db = sign * b[axis] - limit;
    if (da <= 0.0) kept.push_back(a);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

Corners between(const Corners& polygon, double low, double high) {
  return cut(cut(polygon, 2, -1.0, -low), 2, 1.0, high);
}

Convex seen_from_above(const Corners& polygon) {
  std::vector<Vec2> points;
  for (const Vec3& corner : polygon) points.emplace_back(corner.head<2>());
  return convex_hull(std::move(points));
}

void add_between(const Corners& polygon, double low, double high, std::vector<Convex>& shapes) {
  if (low > high) return;
  if (Convex shape = seen_from_above(between(polygon, low, high)); !shape.empty())
    shapes.push_back(std::move(shape));
}

/// Whether a line along a side of `a` separates two polygons by at least the margin. Polygons of two corners have two sides.
bool sides_separate(const Convex& a, const Convex& b) {
  for (std::size_t i = 0; i < a.size() && a.size() > 1; ++i) {
    const Vec2 side = (a[(i + 1) % a.size()] - a[i]).normalized();
    const auto is_right_of = [&](const Vec2& p) { return cross(side, p - a[i]) <= -kMargin; };
    if (std::all_of(b.begin(), b.end(), is_right_of)) return true;
  }
  return false;
}

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - share * ab).norm();
}

bool segments_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
}

bool contains(const Convex& polygon, const Vec2& point) {
  if (polygon.size() < 3) return false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (cross(polygon[(i + 1) % polygon.size()] - polygon[i], point - polygon[i]) < 0.0) return false;
  }
  return true;
}

double distance(const Vec2& a, const Vec2& b, const Convex& polygon) {
  if (contains(polygon, a)) return 0.0;
  double least = INFINITY;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &c = polygon[i], &d = polygon[(i + 1) % polygon.size()];
    if (segments_cross(a, b, c, d)) return 0.0;
    least = std::min({least, distance_to_segment(a, c, d), distance_to_segment(b, c, d),
                      distance_to_segment(c, a, b), distance_to_segment(d, a, b)});
  }
  return least;
}

/// What is left of pieces outside of a polygon.
std::vector<Convex> without(const std::vector<Convex>& pieces, const Convex& polygon) {
  std::vector<Convex> left;
  for (Convex piece : pieces) {
    for (std::size_t i = 0; i < polygon.size() && !piece.empty(); ++i) {
      const Vec2 side = polygon[(i + 1) % polygon.size()] - polygon[i];
      const Vec2 out = Vec2(side.y(), -side.x()).normalized();
      const double offset = out.dot(polygon[i]);
      Convex outside = clip(piece, -out, -offset);
      if (outside.size() >= 3 && polygon_area(outside) > kSpeck) left.push_back(std::move(outside));
      piece = clip(piece, out, offset);
    }
  }
  return left;
}

}  // namespace

LocalFloor::LocalFloor(const Obstacles& obstacles, const FloorBands& bands, const Pose& frame, double range) {
  const double low = -bands.wheel_down, high = std::max(bands.body_high + kMargin, bands.wheel_up);
  Box box;
  for (int i = 0; i < 8; ++i)
    box.extend(frame * Vec3(i & 1 ? range : -range, i & 2 ? range : -range, i & 4 ? high : low));
  std::vector<std::uint32_t> near;
  obstacles.near(box, near);
  const Pose plane = frame.inverse();
  for (const std::uint32_t index : near) {
    Corners polygon;
    for (const Vec3& corner : obstacles.triangle(index)) polygon.push_back(plane * corner);
    for (const Eigen::Index axis : {0, 1}) {
      polygon = cut(polygon, axis, 1.0, range);
      polygon = cut(polygon, axis, -1.0, range);
    }
    if (polygon.empty()) continue;
    const auto [lowest, highest] = std::minmax_element(
        polygon.begin(), polygon.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
    if (highest->z() <= bands.flat) {
      if (lowest->z() >= -bands.flat) {
        if (Convex shape = seen_from_above(polygon); shape.size() >= 3) ground_.push_back(std::move(shape));
      }
      continue;
    }
    add_between(polygon, bands.flat, bands.wheel_up, bumps_);
    add_between(polygon, bands.body_low - kMargin, bands.body_high + kMargin, body_);
    add_between(polygon, bands.wall_low, bands.wall_high, walls_);
  }
}

bool LocalFloor::is_apart(const std::vector<Convex>& shapes, const Convex& area) {
  return std::all_of(shapes.begin(), shapes.end(), [&](const Convex& shape) {
    return sides_separate(area, shape) || sides_separate(shape, area);
  });
}

bool LocalFloor::is_free(const Vec2& a, const Vec2& b, double radius) const {
  return std::all_of(body_.begin(), body_.end(),
                     [&](const Convex& shape) { return distance(a, b, shape) >= radius + kMargin; });
}

bool LocalFloor::is_flat(const Convex& area) const {
  if (!is_apart(bumps_, area)) return false;
  std::vector<Convex> left{area};
  for (const Convex& shape : ground_) {
    const auto is_inside = [&](const Vec2& corner) { return contains(shape, corner); };
    if (std::all_of(area.begin(), area.end(), is_inside)) return true;
  }
  for (const Convex& shape : ground_) {
    left = without(left, shape);
    if (left.empty()) return true;
    if (left.size() > kMostPieces) return false;
  }
  return false;
}

Convex round_area(double radius) {
  constexpr int kCorners = 16;
  std::vector<Vec2> corners;
  const double out = radius / std::cos(std::numbers::pi / kCorners);
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    corners.emplace_back(out * std::cos(angle), out * std::sin(angle));
  }
  return convex_hull(std::move(corners));
}

Convex swept(const Convex& area, const Vec2& by) {
  Convex points = area;
  for (const Vec2& corner : area) points.push_back(corner + by);
  return convex_hull(std::move(points));
}

}  // namespace hallway::contact
