// SPDX-License-Identifier: MIT
#include "planes/rectangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hallway::planes {
namespace {

struct Segment {
  Vec3 a, b;
};

Vec3 normal_of(const Corners& corners) {
  return (corners[1] - corners[0]).cross(corners[3] - corners[0]);
}

/// Whether a point of the rectangle's plane lies within it.
bool holds(const Corners& corners, const Vec3& normal, const Vec3& point) {
  for (std::size_t i = 0; i < 4; ++i) {
    if ((corners[(i + 1) % 4] - corners[i]).cross(point - corners[i]).dot(normal) < 0) return false;
  }
  return true;
}

double point_to_segment(const Vec3& point, const Segment& segment) {
  const Vec3 along = segment.b - segment.a;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp((point - segment.a).dot(along) / length, 0.0, 1.0) : 0.0;
  return (point - segment.a - t * along).norm();
}

/// Between interior points where the lines come nearest, if that lies within both; else an end point is one of the nearest.
double segment_to_segment(const Segment& p, const Segment& q) {
  double least = std::min({point_to_segment(p.a, q), point_to_segment(p.b, q), point_to_segment(q.a, p),
                           point_to_segment(q.b, p)});
  const Vec3 u = p.b - p.a, v = q.b - q.a, w = p.a - q.a;
  const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm();
  const double determinant = uu * vv - uv * uv;
  if (determinant <= 1e-12 * uu * vv) return least;  // parallel
  const double s = (uv * v.dot(w) - vv * u.dot(w)) / determinant;
  const double t = (uu * v.dot(w) - uv * u.dot(w)) / determinant;
  if (s < 0 || s > 1 || t < 0 || t > 1) return least;
  return std::min(least, (w + s * u - t * v).norm());
}

/// Distance of a segment from the inside of a rectangle; infinite where its rim is nearer.
double segment_to_face(const Segment& segment, const Corners& corners) {
  const Vec3 normal = normal_of(corners);
  const double size = normal.norm();
  double least = std::numeric_limits<double>::infinity();
  if (size == 0) return least;
  const Vec3 unit = normal / size;
  const double a = unit.dot(segment.a - corners[0]), b = unit.dot(segment.b - corners[0]);
  if (a * b <= 0 && a != b) {
    if (holds(corners, normal, segment.a + a / (a - b) * (segment.b - segment.a))) return 0.0;
  }
  if (holds(corners, normal, segment.a - a * unit)) least = std::min(least, std::abs(a));
  if (holds(corners, normal, segment.b - b * unit)) least = std::min(least, std::abs(b));
  return least;
}

Segment edge(const Corners& corners, std::size_t i) {
  return {corners[i], corners[(i + 1) % 4]};
}

}  // namespace

double rectangle_distance(const Corners& a, const Corners& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    least = std::min({least, segment_to_face(edge(a, i), b), segment_to_face(edge(b, i), a)});
    for (std::size_t k = 0; k < 4; ++k) least = std::min(least, segment_to_segment(edge(a, i), edge(b, k)));
  }
  return least;
}

}  // namespace hallway::planes
