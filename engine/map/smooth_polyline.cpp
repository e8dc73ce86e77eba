// SPDX-License-Identifier: MIT
#include "map/smooth_polyline.hpp"

#include <algorithm>
#include <cmath>

#include "map/gauss_legendre.hpp"

namespace hallway::map {
namespace {

/// From 0 to 1, with two derivatives that are 0 at both ends.
double turned_share(double u) {
  return u * u * u * (10.0 - u * (15.0 - 6.0 * u));
}

}  // namespace

CornerBlend::CornerBlend(double turn, double trim_m) : turn_(turn), length_m_(0.0) {
  nodes_[0] = Vec2::Zero();
  for (std::size_t i = 0; i < kCells; ++i) {
    const auto from = static_cast<double>(i) / kCells, to = static_cast<double>(i + 1) / kCells;
    nodes_.at(i + 1) = nodes_.at(i) + unit_step(from, to);
  }
  // Begin, corner and end are an isosceles triangle.
  length_m_ = trim_m * 2.0 * std::cos(0.5 * turn) / nodes_.back().norm();
}

Vec2 CornerBlend::unit_step(double from, double to) const {
  const auto direction = [this](double u) {
    const double angle = turn_ * turned_share(u);
    return Vec2(std::cos(angle), std::sin(angle));
  };
  return gauss_legendre(direction, from, to, Vec2(Vec2::Zero()));
}

Vec2 CornerBlend::position(double along_m) const {
  const double u = std::clamp(along_m / length_m_, 0.0, 1.0);
  const std::size_t cell = std::min(static_cast<std::size_t>(u * kCells), kCells - 1);
  return length_m_ * (nodes_.at(cell) + unit_step(static_cast<double>(cell) / kCells, u));
}

CornerBlend::Heading CornerBlend::heading(double along_m) const {
  const double u = std::clamp(along_m / length_m_, 0.0, 1.0), rest = 1.0 - u;
  return {.angle = turn_ * turned_share(u),
          .curvature = turn_ / length_m_ * 30.0 * u * u * rest * rest,
          .slope = turn_ / (length_m_ * length_m_) * 60.0 * u * rest * (rest - u)};
}

SmoothPolyline::SmoothPolyline(std::span<const Vec3> waypoints, bool closed, double corner_radius_m)
    : pieces_(waypoints, closed, corner_radius_m,
              [](double turn, double trim_m) { return CornerBlend(turn, trim_m); }) {}

CurvePoint SmoothPolyline::point(double distance_m) const {
  const auto [piece, along] = pieces_.at(distance_m);
  if (!piece.corner) return {.position = piece.start + along * piece.direction, .tangent = piece.direction};
  const Vec2 place = piece.corner->position(along);
  const CornerBlend::Heading heading = piece.corner->heading(along);
  const double c = std::cos(heading.angle), s = std::sin(heading.angle);
  const Vec3 tangent = c * piece.direction + s * piece.inward;
  const Vec3 normal = c * piece.inward - s * piece.direction;
  return {.position = piece.start + place.x() * piece.direction + place.y() * piece.inward,
          .tangent = tangent,
          .curvature = heading.curvature * normal,
          .curvature_slope = heading.slope * normal - heading.curvature * heading.curvature * tangent};
}

Pose SmoothPolyline::at(double distance_m) const {
  const CurvePoint here = point(distance_m);
  return look_along(here.position, here.tangent);
}

}  // namespace hallway::map
