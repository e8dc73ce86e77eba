// SPDX-License-Identifier: MIT
#include "map/smooth_polyline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "map/gauss_legendre.hpp"
#include "map/polyline_corners.hpp"

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
    : closed_(closed) {
  const std::size_t count = waypoints.size();
  const PolylineCorners corners = measure_corners(waypoints, closed, corner_radius_m);
  for (std::size_t i = 0; i < corners.directions.size(); ++i) {
    const std::size_t next = (i + 1) % count;
    const Vec3& direction = corners.directions[i];
    Piece line;
    line.start = waypoints[i] + direction * corners.trims[i];
    line.direction = direction;
    line.length_m = std::max(corners.lengths[i] - corners.trims[i] - corners.trims[next], 0.0);
    append(std::move(line));
    if (corners.turns[next] == 0.0) continue;
    const Vec3& after = corners.directions[next];
    Piece corner;
    corner.start = waypoints[next] - direction * corners.trims[next];
    corner.direction = direction;
    corner.inward = (after - direction * direction.dot(after)).normalized();
    corner.blend = std::make_shared<const CornerBlend>(corners.turns[next], corners.trims[next]);
    corner.length_m = corner.blend->length_m();
    append(std::move(corner));
  }
}

void SmoothPolyline::append(Piece piece) {
  piece.begin_m = length_m_;
  length_m_ += piece.length_m;
  pieces_.push_back(std::move(piece));
}

std::vector<double> SmoothPolyline::jumps_m() const {
  std::vector<double> jumps;
  for (const Piece& piece : pieces_) jumps.push_back(piece.begin_m);
  jumps.push_back(length_m_);
  jumps.erase(std::unique(jumps.begin(), jumps.end()), jumps.end());
  return jumps;
}

CurvePoint SmoothPolyline::point(double distance_m) const {
  const double distance = distance_within(distance_m, length_m_, closed_);
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), distance,
                                      [](double value, const Piece& piece) { return value < piece.begin_m; });
  const Piece& piece = *std::prev(after);
  const double along = distance - piece.begin_m;
  if (piece.blend == nullptr)
    return {.position = piece.start + along * piece.direction, .tangent = piece.direction};
  const Vec2 place = piece.blend->position(along);
  const CornerBlend::Heading heading = piece.blend->heading(along);
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
