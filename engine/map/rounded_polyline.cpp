// SPDX-License-Identifier: MIT
#include "map/rounded_polyline.hpp"

#include <algorithm>
#include <cmath>

#include "map/polyline_corners.hpp"

namespace hallway::map {

RoundedPolyline::RoundedPolyline(std::span<const Vec3> waypoints, bool closed, double corner_radius_m)
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
    append(line);
    if (corners.turns[next] == 0.0) continue;
    const Vec3& after = corners.directions[next];
    Piece arc;
    arc.start = waypoints[next] - direction * corners.trims[next];
    arc.direction = direction;
    arc.inward = (after - direction * direction.dot(after)).normalized();
    arc.radius_m = corner_radius_m;
    arc.length_m = corner_radius_m * corners.turns[next];
    append(arc);
  }
}

void RoundedPolyline::append(Piece piece) {
  piece.begin_m = length_m_;
  length_m_ += piece.length_m;
  pieces_.push_back(piece);
}

std::vector<double> RoundedPolyline::jumps_m() const {
  std::vector<double> jumps;
  for (const Piece& piece : pieces_) jumps.push_back(piece.begin_m);
  jumps.push_back(length_m_);
  jumps.erase(std::unique(jumps.begin(), jumps.end()), jumps.end());
  return jumps;
}

CurvePoint RoundedPolyline::point(double distance_m, CurveSide side) const {
  const double distance = distance_within(distance_m, length_m_, closed_);
  const auto is_later = [side](double value, const Piece& piece) {
    return side == CurveSide::kAfter ? value < piece.begin_m : value <= piece.begin_m;
  };
  auto after = std::upper_bound(pieces_.begin(), pieces_.end(), distance, is_later);
  // Before the first piece of a closed path is its last one.
  const bool wraps = after == pieces_.begin();
  const Piece& piece = wraps ? (closed_ ? pieces_.back() : pieces_.front()) : *std::prev(after);
  const double along = wraps ? (closed_ ? piece.length_m : 0.0) : distance - piece.begin_m;
  if (piece.radius_m == 0.0)
    return {.position = piece.start + along * piece.direction, .tangent = piece.direction};
  const double angle = along / piece.radius_m;
  const double s = std::sin(angle), c = std::cos(angle);
  const Vec3 tangent = c * piece.direction + s * piece.inward;
  return {.position = piece.start + piece.radius_m * (s * piece.direction + (1.0 - c) * piece.inward),
          .tangent = tangent,
          .curvature = (c * piece.inward - s * piece.direction) / piece.radius_m,
          .curvature_slope = -tangent / (piece.radius_m * piece.radius_m)};
}

Pose RoundedPolyline::at(double distance_m) const {
  const double distance = distance_within(distance_m, length_m_, closed_);
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), distance,
                                      [](double value, const Piece& piece) { return value < piece.begin_m; });
  const Piece& piece = *std::prev(after);
  const double along = distance - piece.begin_m;
  if (piece.radius_m == 0.0) return look_along(piece.start + along * piece.direction, piece.direction);
  const double angle = along / piece.radius_m;
  const double s = std::sin(angle);
  const double c = std::cos(angle);
  return look_along(piece.start + piece.radius_m * (s * piece.direction + (1.0 - c) * piece.inward),
                    c * piece.direction + s * piece.inward);
}

}  // namespace hallway::map
