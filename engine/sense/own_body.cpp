// SPDX-License-Identifier: MIT
#include "sense/own_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hallway::sense {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The part of a ray, as distances, that is in a body so far.
struct Inside {
  double begin = -kNever;
  double end = kNever;

  /// Cuts by a half-space: of points whose `height` = at + distance * slope is at most 0.
  void cut(double at, double slope) {
    if (slope == 0.0) {
      if (at > 0.0) end = -kNever;
    } else if (slope > 0.0) {
      end = std::min(end, -at / slope);
    } else {
      begin = std::max(begin, -at / slope);
    }
  }
};

}  // namespace

bool OwnBody::contains(const Vec3& point) const {
  if (point.z() < bottom_m || point.z() > top_m) return false;
  const Vec2 flat = point.head<2>();
  if (corners.empty()) return (flat - middle).norm() <= radius_m;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 edge = corners[(i + 1) % corners.size()] - corners[i];
    const Vec2 to = flat - corners[i];
    if (edge.x() * to.y() - edge.y() * to.x() < 0.0) return false;
  }
  return true;
}

double OwnBody::entry_m(const Vec3& origin, const Vec3& direction) const {
  if (contains(origin)) return kNever;
  Inside inside;
  inside.cut(bottom_m - origin.z(), -direction.z());
  inside.cut(origin.z() - top_m, direction.z());
  if (corners.empty()) {
    const Vec2 from = origin.head<2>() - middle, along = direction.head<2>();
    const double a = along.squaredNorm(), b = from.dot(along), c = from.squaredNorm() - radius_m * radius_m;
    const double root = b * b - a * c;
    if (a == 0.0) {
      if (c > 0.0) return kNever;
    } else {
      if (root <= 0.0) return kNever;
      inside.begin = std::max(inside.begin, (-b - std::sqrt(root)) / a);
      inside.end = std::min(inside.end, (-b + std::sqrt(root)) / a);
    }
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 edge = corners[(i + 1) % corners.size()] - corners[i];
    const Vec2 outward(edge.y(), -edge.x());
    inside.cut(outward.dot(origin.head<2>() - corners[i]), outward.dot(direction.head<2>()));
  }
  return inside.begin <= inside.end && inside.begin >= 0.0 ? inside.begin : kNever;
}

}  // namespace hallway::sense
