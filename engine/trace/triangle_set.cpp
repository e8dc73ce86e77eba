// SPDX-License-Identifier: MIT
#include "trace/triangle_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"
#include "trace/scene.hpp"

namespace hallway::trace {
namespace {

/// Sine of the angle to a triangle's plane below which a line runs along it. Rounding of about 1e-16 of the
/// coordinates, divided by this, stays below kRelativeSlack; a line so flat passes within 0.1 mm of an edge
/// of any triangle that is shorter than 100 km.
constexpr double kParallel = 1e-9;

/// Bound on the error of a computed volume over w (w + d), where w is how far the triangle's corners lie from
/// the point of the line beside it, and d how far that point is from the line's origin: 2^-53 times the
/// number of roundings (8 in the triple product, times sqrt 3; 6 in the corners, twice), rounded up.
constexpr double kVolumeRounding = 4e-15;

/// Slack of the box test, relative to the scene's radius.
constexpr double kRelativeSlack = 4e-6;

[[noreturn]] void refuse(const std::string& element, const std::string& message) {
  throw Error(ErrorCode::kBadInput, message, {.element = element});
}

void check(const TriangleMesh& mesh) {
  if (mesh.triangles.size() >= std::numeric_limits<std::uint32_t>::max()) {
    refuse("scene",
           "has " + std::to_string(mesh.triangles.size()) + " triangles; there may be at most 2^32 - 2");
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& v = mesh.vertices[i];
    if (v.allFinite() && v.cwiseAbs().maxCoeff() <= Scene::kMaxCoordinate) continue;
    refuse("vertex " + std::to_string(i), "(" + format_double(v.x()) + ", " + format_double(v.y()) + ", " +
                                              format_double(v.z()) + ") is not within " +
                                              format_double(Scene::kMaxCoordinate) + " m of the origin");
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t highest = *std::max_element(mesh.triangles[i].begin(), mesh.triangles[i].end());
    if (highest < mesh.vertices.size()) continue;
    refuse("triangle " + std::to_string(i), "uses vertex " + std::to_string(highest) +
                                                ", but there are only " +
                                                std::to_string(mesh.vertices.size()));
  }
}

Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double length = normal.norm();
  return length > 0.0 ? Vec3(normal / length) : Vec3::Zero();
}

/// d . (p x q), spelt out: Eigen's cross product followed by its packed dot product stalls on the way through
/// memory and is about three times as slow.
double volume(const Vec3& d, const Vec3& p, const Vec3& q) {
  return d.x() * (p.y() * q.z() - p.z() * q.y()) + d.y() * (p.z() * q.x() - p.x() * q.z()) +
         d.z() * (p.x() * q.y() - p.y() * q.x());
}

}  // namespace

TriangleSet::TriangleSet(const TriangleMesh& mesh) {
  check(mesh);
  triangles_.reserve(mesh.triangles.size());
  for (const auto& corner : mesh.triangles) {
    const Vec3& a = mesh.vertices[corner[0]];
    const Vec3& b = mesh.vertices[corner[1]];
    const Vec3& c = mesh.vertices[corner[2]];
    triangles_.push_back({a, b, c, unit_normal(a, b, c)});
    bounds_.extend(a).extend(b).extend(c);
  }
  if (!bounds_.isEmpty()) radius_m_ = std::max(radius_m_, 0.5 * bounds_.diagonal().norm());
  box_slack_m_ = kRelativeSlack * radius_m_;
}

std::optional<double> TriangleSet::hit(std::uint32_t triangle, const SightLine& line) const {
  const Triangle& t = triangles_[triangle];
  // Corners as seen from the point of the line beside corner a: errors then grow with the distance, not with
  // its square.
  const Vec3 to_a = t.a - line.origin;
  const double along = line.direction.dot(to_a);
  const Vec3 a = to_a - along * line.direction;
  const Vec3 b = t.b - line.origin - along * line.direction;
  const Vec3 c = t.c - line.origin - along * line.direction;
  const double ab = volume(line.direction, a, b);
  const double bc = volume(line.direction, b, c);
  const double ca = volume(line.direction, c, a);
  const double least = std::min({ab, bc, ca});
  const double most = std::max({ab, bc, ca});
  if (least < 0.0 && most > 0.0) {
    const double width_squared = std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
    // A bound on the bound, free of square roots, settles nearly all misses.
    const double coarse = 2.0 * kVolumeRounding * (width_squared + along * along);
    if (least < -coarse && most > coarse) return std::nullopt;
    const double width = std::sqrt(width_squared);
    const double rounding = kVolumeRounding * width * (width + std::abs(along));
    if (least < -rounding && most > rounding) return std::nullopt;
  }

  const double facing = t.normal.dot(line.direction);
  if (std::abs(facing) < kParallel) return std::nullopt;
  const double distance = t.normal.dot(to_a) / facing;
  if (!(distance >= 0.0 && distance <= line.max_distance)) return std::nullopt;

  const Vec3 point = line.origin + distance * line.direction;
  const Vec3 low = t.a.cwiseMin(t.b).cwiseMin(t.c);
  const Vec3 high = t.a.cwiseMax(t.b).cwiseMax(t.c);
  const bool in_box =
      ((point - low).array() >= -box_slack_m_).all() && ((point - high).array() <= box_slack_m_).all();
  return in_box ? std::optional(distance) : std::nullopt;
}

Box TriangleSet::box(std::uint32_t triangle) const {
  const Triangle& t = triangles_[triangle];
  return Box(t.a).extend(t.b).extend(t.c);
}

}  // namespace hallway::trace
