// SPDX-License-Identifier: MIT
#include "map/rounded_polyline.hpp"

#include <cmath>

namespace hallway::map {

RoundedPolyline::RoundedPolyline(std::span<const Vec3> waypoints, bool closed, double corner_radius_m)
    : pieces_(waypoints, closed, corner_radius_m,
              [=](double turn, double) { return Arc{.radius_m = corner_radius_m, .turn = turn}; }) {}

CurvePoint RoundedPolyline::point(double distance_m, CurveSide side) const {
  const auto [piece, along] = pieces_.at(distance_m, side);
  if (!piece.corner) return {.position = piece.start + along * piece.direction, .tangent = piece.direction};
  const double radius = piece.corner->radius_m;
  const double angle = along / radius;
  const double s = std::sin(angle), c = std::cos(angle);
  const Vec3 tangent = c * piece.direction + s * piece.inward;
  return {.position = piece.start + radius * (s * piece.direction + (1.0 - c) * piece.inward),
          .tangent = tangent,
          .curvature = (c * piece.inward - s * piece.direction) / radius,
          .curvature_slope = -tangent / (radius * radius)};
}

Pose RoundedPolyline::at(double distance_m) const {
  const CurvePoint here = point(distance_m, CurveSide::kAfter);
  return look_along(here.position, here.tangent);
}

}  // namespace hallway::map
