// SPDX-License-Identifier: MIT
#include "contact/shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"

namespace hallway::contact {
namespace {

constexpr std::size_t kMostVertices = 1024;

/// Four points that span the hull: each is the farthest from what the ones before it span. Distances from point, line and plane.
bool has_thickness(const std::vector<Vec3>& points) {
  const Vec3 a = points.front();
  const auto farthest = [&](auto distance) {
    return *std::max_element(points.begin(), points.end(),
                             [&](const Vec3& p, const Vec3& q) { return distance(p) < distance(q); });
  };
  const Vec3 b = farthest([&](const Vec3& p) { return (p - a).norm(); });
  if ((b - a).norm() < kLeastBodySize) return false;
  const Vec3 along = (b - a).normalized();
  const auto from_line = [&](const Vec3& p) { return (p - a).cross(along).norm(); };
  const Vec3 c = farthest(from_line);
  if (from_line(c) < kLeastBodySize) return false;
  const Vec3 normal = along.cross(c - a).normalized();
  const auto from_plane = [&](const Vec3& p) { return std::abs(normal.dot(p - a)); };
  return from_plane(farthest(from_plane)) >= kLeastBodySize;
}

}  // namespace

BodyShape BodyShape::polytope(std::vector<Vec3> vertices) {
  const bool in_range = std::all_of(vertices.begin(), vertices.end(), [](const Vec3& p) {
    return p.allFinite() && p.norm() <= kGreatestBodySize;
  });
  if (!in_range) throw Error(ErrorCode::kBadInput, "a body's corners must be within 1000 m of its origin");
  if (vertices.size() > kMostVertices)
    throw Error(ErrorCode::kBadInput, "a body may have at most 1024 corners");
  if (vertices.size() < 4 || !has_thickness(vertices))
    throw Error(ErrorCode::kBadInput, "a body must be at least 1 mm thick in every direction");
  BodyShape shape;
  shape.vertices_ = std::move(vertices);
  for (const Vec3& p : shape.vertices_) shape.radius_ = std::max(shape.radius_, p.norm());
  return shape;
}

BodyShape BodyShape::box(const Vec3& low, const Vec3& high) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                         (i & 4) != 0 ? high.z() : low.z());
  }
  return polytope(std::move(corners));
}

BodyShape BodyShape::cylinder(double radius, double low, double high, const Vec2& axis) {
  BodyShape shape;
  shape.axis_ = Vec3(axis.x(), axis.y(), low);
  shape.cylinder_radius_ = radius;
  shape.height_ = high - low;
  shape.radius_ = std::hypot(axis.norm() + radius, std::max(std::abs(low), std::abs(high)));
  if (!(radius >= kLeastBodySize && shape.height_ >= kLeastBodySize && shape.radius_ <= kGreatestBodySize))
    throw Error(ErrorCode::kBadInput, "a body's radius and height must be between 1 mm and 1000 m");
  return shape;
}

Vec3 BodyShape::support(const Vec3& direction) const {
  if (vertices_.empty()) {
    Vec3 point = axis_;
    const double level = std::hypot(direction.x(), direction.y());
    if (level > 0.0) point.head<2>() += direction.head<2>() * (cylinder_radius_ / level);
    if (direction.z() > 0.0) point.z() += height_;
    return point;
  }
  const Vec3* best = &vertices_.front();
  double farthest = direction.dot(*best);
  for (const Vec3& p : vertices_) {
    const double along = direction.dot(p);
    if (along > farthest) {
      farthest = along;
      best = &p;
    }
  }
  return *best;
}

Box BodyShape::box_at(const Pose& pose) const {
  const Mat3 rotation = pose.q.toRotationMatrix();
  Box box;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vec3 row = rotation.row(axis);
    box.min()[axis] = pose.t[axis] - extent(-row);
    box.max()[axis] = pose.t[axis] + extent(row);
  }
  return box;
}

}  // namespace hallway::contact
