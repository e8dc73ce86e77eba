// SPDX-License-Identifier: MIT
#include "sense/face_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hallway::sense {
namespace {

constexpr double kLeastAway_m = 1e-6;    ///< from a face's plane, to see it at all
constexpr double kOnFace_m = 1e-6;       ///< what does not stand out of a face farther hides nothing of it
constexpr double kFlatOfPiece_m = 1e-6;  ///< a corner that stands out less is none
constexpr double kNoArea_m2 = 1e-9;

/// What of a polygon lies on the side that the plane's normal points to.
void keep_before(std::vector<Vec3>& vertices, const Plane& plane) {
  std::vector<Vec3> kept;
  const std::size_t n = vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &a = vertices[i], &b = vertices[(i + 1) % n];
    const double da = plane.distance(a), db = plane.distance(b);
    if (da >= 0.0) kept.push_back(a);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  vertices = std::move(kept);
}

/// Where rays from the sensor, which is in the origin, through an obstacle meet the plane of a face.
Convex shadow(std::vector<Vec3> obstacle, const Plane& plane, const PlaneAxes& axes) {
  const double distance_m = -plane.offset;  // of the sensor
  keep_before(obstacle, {plane.normal, plane.offset + kOnFace_m});
  keep_before(obstacle, {-plane.normal, -(plane.offset + distance_m * (1.0 - 1e-6))});
  if (obstacle.size() < 3) return {};
  std::vector<Vec2> points;
  for (const Vec3& p : obstacle) points.push_back(axes.flat(p * (plane.offset / plane.normal.dot(p))));
  return hull_of(std::move(points), 0.0);
}

}  // namespace

FaceView::FaceView(const FaceViewSpec& spec, const FacePlan& plan) : spec_(spec), plan_(plan) {
  for (const double side : {-1.0, 1.0}) {
    const double h = 0.5 * spec.horizontal_fov, v = 0.5 * spec.vertical_fov;
    borders_.push_back({Vec3(std::sin(h), side * std::cos(h), 0.0), 0.0});
    borders_.push_back({Vec3(std::sin(v), 0.0, side * std::cos(v)), 0.0});
  }
  borders_.push_back({Vec3::UnitX(), std::max(spec.min_range_m, kLeastAway_m)});
  borders_.push_back({-Vec3::UnitX(), -spec.max_range_m});
}

Polygon FaceView::in_view(const Polygon& polygon, const Pose& T_sensor_world) const {
  Polygon seen;
  seen.plane.normal = T_sensor_world.q * polygon.plane.normal;
  seen.plane.offset = polygon.plane.offset + seen.plane.normal.dot(T_sensor_world.t);
  for (const Vec3& vertex : polygon.vertices) seen.vertices.push_back(T_sensor_world * vertex);
  for (const Plane& border : borders_) {
    keep_before(seen.vertices, border);
    if (seen.vertices.size() < 3) {
      seen.vertices.clear();
      break;
    }
  }
  return seen;
}

void FaceView::find(const Pose& T_world_sensor, std::vector<VisibleFace>& pieces) const {
  const Pose T_sensor_world = T_world_sensor.inverse();
  std::vector<Polygon> obstacles;
  if (spec_.occlusion) {
    for (const Polygon& obstacle : plan_.obstacles) {
      Polygon seen = in_view(obstacle, T_sensor_world);
      if (!seen.vertices.empty() && std::abs(seen.plane.offset) > kLeastAway_m)
        obstacles.push_back(std::move(seen));
    }
  }
  pieces.clear();
  for (std::size_t i = 0; i < plan_.faces.size(); ++i) {
    const Polygon seen = in_view(plan_.faces[i], T_sensor_world);
    if (!seen.vertices.empty() && seen.plane.offset < -kLeastAway_m)
      find_on(seen, static_cast<std::uint32_t>(i), obstacles, pieces);
  }
}

void FaceView::find_on(const Polygon& whole, std::uint32_t face, const std::vector<Polygon>& obstacles,
                       std::vector<VisibleFace>& pieces) const {
  const PlaneAxes axes(whole.plane.normal);
  std::vector<Vec2> corners;
  for (const Vec3& vertex : whole.vertices) corners.push_back(axes.flat(vertex));
  std::vector<Convex> visible{hull_of(corners, 0.0)};
  for (const Polygon& obstacle : obstacles) {
    if (visible.empty()) return;
    subtract(visible, shadow(obstacle.vertices, whole.plane, axes));
  }
  std::vector<Vec2> points;
  for (const Convex& part : visible) {
    if (polygon_area(part) > kNoArea_m2) points.insert(points.end(), part.begin(), part.end());
  }
  const Convex hull = hull_of(std::move(points), kFlatOfPiece_m);
  if (hull.size() < 3 || width(hull) < spec_.min_length_m) return;
  VisibleFace& piece = pieces.emplace_back();
  piece.face = face;
  piece.seen.plane = whole.plane;
  for (const Vec2& p : hull) piece.seen.vertices.push_back(axes.lift(p, whole.plane.offset));
}

}  // namespace hallway::sense
