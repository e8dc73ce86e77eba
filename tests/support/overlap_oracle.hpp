// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::contact::test {

/// Whether the convex hull of points and a triangle are apart, by the separating axis theorem: all axes that could be the normal of a separating plane are
/// tried, edges of the hull being among the differences of its points. It shares no code with the library.
class HullOracle {
 public:
  explicit HullOracle(std::vector<Vec3> points) : points_(std::move(points)) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      for (std::size_t j = i + 1; j < points_.size(); ++j) {
        add(edges_, points_[j] - points_[i]);
        for (std::size_t k = j + 1; k < points_.size(); ++k)
          add(normals_, (points_[j] - points_[i]).cross(points_[k] - points_[i]));
      }
    }
  }

  /// The greatest gap between both along an axis of those; negative if they overlap on all.
  double gap(const Pose& pose, const std::array<Vec3, 3>& world) const {
    std::array<Vec3, 3> triangle;
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = pose.q.conjugate() * (world[i] - pose.t);
    double best = -INFINITY;
    const auto offer = [&](const Vec3& axis) {
      const double length = axis.norm();
      if (length < 1e-9) return false;
      best = std::max(best, along(axis / length, triangle));
      return best > 0.0;
    };
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
      if (offer(axis)) return best;
    }
    const std::array<Vec3, 3> sides{triangle[1] - triangle[0], triangle[2] - triangle[1],
                                    triangle[0] - triangle[2]};
    const Vec3 across = sides[0].cross(sides[1]);
    if (offer(across)) return best;
    for (const Vec3& normal : normals_) {
      if (offer(normal)) return best;
    }
    for (const Vec3& side : sides) {
      if (offer(side.cross(across))) return best;
      for (const Vec3& edge : edges_) {
        if (offer(side.cross(edge))) return best;
      }
    }
    return best;
  }

 private:
  static void add(std::vector<Vec3>& axes, const Vec3& axis) {
    if (axis.norm() < 1e-9) return;
    const Vec3 unit = axis.normalized();
    const bool known = std::any_of(axes.begin(), axes.end(),
                                   [&](const Vec3& other) { return other.cross(unit).norm() < 1e-9; });
    if (!known) axes.push_back(unit);
  }

  double along(const Vec3& axis, const std::array<Vec3, 3>& triangle) const {
    double low = INFINITY, high = -INFINITY, first = INFINITY, last = -INFINITY;
    for (const Vec3& p : points_) {
      low = std::min(low, axis.dot(p));
      high = std::max(high, axis.dot(p));
    }
    for (const Vec3& p : triangle) {
      first = std::min(first, axis.dot(p));
      last = std::max(last, axis.dot(p));
    }
    return std::max(first - high, low - last);
  }

  std::vector<Vec3> points_, edges_, normals_;
};

/// Distance in the level between an upright cylinder and a triangle, in closed form: the triangle is cut to the cylinder's heights, and its outline's
/// distance to the axis is taken. Negative inside; infinite if the heights do not meet.
inline double cylinder_gap(const Vec3& foot, double radius, double low, double high,
                           const std::array<Vec3, 3>& triangle) {
  std::vector<Vec3> polygon(triangle.begin(), triangle.end());
  for (const double sign : {1.0, -1.0}) {
    const double level = sign > 0.0 ? foot.z() + low : -(foot.z() + high);
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double da = sign * a.z() - level, db = sign * b.z() - level;
      if (da >= 0.0) kept.push_back(a);
      if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) kept.push_back(a + (b - a) * (da / (da - db)));
    }
    polygon = kept;
  }
  if (polygon.empty()) return INFINITY;
  double nearest = INFINITY;
  int left = 0, right = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i].head<2>() - foot.head<2>();
    const Vec2 b = polygon[(i + 1) % polygon.size()].head<2>() - foot.head<2>();
    const Vec2 ab = b - a;
    const double share = ab.squaredNorm() > 0.0 ? std::clamp(-a.dot(ab) / ab.squaredNorm(), 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (a + share * ab).norm());
    const double side = a.x() * b.y() - a.y() * b.x();
    left += side > 0.0 ? 1 : 0;
    right += side < 0.0 ? 1 : 0;
  }
  if ((left == 0) != (right == 0)) return -radius;  // the axis passes the outline
  return nearest - radius;
}

}  // namespace hallway::contact::test
