// SPDX-License-Identifier: MIT
#include "map/rounded_polyline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"

namespace hallway::map {
namespace {

constexpr double kNoTurn = 1e-12;   ///< radians; less is a straight line
constexpr double kTurnBack = 0.01;  ///< radians short of a half turn
constexpr double kVertical = 1e-3;  ///< share of a line's length that must be level, to have a heading
constexpr double kSamePlace_m = 1e-9;

/// The lines between waypoints and what the arcs at their ends take from them.
struct Corners {
  std::vector<Vec3> directions;  ///< of line i, from waypoint i to the next
  std::vector<double> lengths;
  std::vector<double> turns;  ///< at waypoint i, radians; 0 at the ends of an open path
  std::vector<double> trims;  ///< what the arc at waypoint i takes from each of its lines, metres
};

std::size_t line_count(std::size_t waypoints, bool closed) {
  return closed ? waypoints : waypoints - 1;
}

Corners measure(std::span<const Vec3> waypoints, bool closed, double radius) {
  const std::size_t count = waypoints.size();
  Corners corners;
  for (std::size_t i = 0; i < line_count(count, closed); ++i) {
    const Vec3 step = waypoints[(i + 1) % count] - waypoints[i];
    corners.lengths.push_back(step.norm());
    corners.directions.push_back(step / step.norm());
  }
  corners.turns.assign(count, 0.0);
  corners.trims.assign(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    if (!closed && (i == 0 || i + 1 == count)) continue;
    const Vec3& before = corners.directions[(i + count - 1) % count];
    const Vec3& after = corners.directions[i];
    const double turn = std::atan2(before.cross(after).norm(), before.dot(after));
    if (turn < kNoTurn) continue;
    corners.turns[i] = turn;
    corners.trims[i] = radius * std::tan(0.5 * turn);
  }
  return corners;
}

}  // namespace

std::optional<RoundedPolyline::Fault> RoundedPolyline::check(std::span<const Vec3> waypoints, bool closed,
                                                             double corner_radius_m) {
  const std::size_t count = waypoints.size();
  const std::size_t least = closed ? 3 : 2;
  if (count < least) {
    return Fault{0, "the path has " + std::to_string(count) + " waypoints; it needs at least " +
                        std::to_string(least)};
  }
  for (std::size_t i = 0; i < line_count(count, closed); ++i) {
    const Vec3 step = waypoints[(i + 1) % count] - waypoints[i];
    if (step.norm() < kSamePlace_m) return Fault{i, "the next waypoint is at the same place"};
    if (step.head<2>().norm() < kVertical * step.norm())
      return Fault{i, "the way to the next waypoint is vertical"};
  }
  const Corners corners = measure(waypoints, closed, corner_radius_m);
  for (std::size_t i = 0; i < count; ++i) {
    if (corners.turns[i] > std::numbers::pi - kTurnBack) return Fault{i, "the path turns straight back here"};
  }
  for (std::size_t i = 0; i < line_count(count, closed); ++i) {
    const double needed = corners.trims[i] + corners.trims[(i + 1) % count];
    constexpr double kRounding = 1e-9;
    if (needed <= corners.lengths[i] * (1.0 + kRounding)) continue;
    return Fault{i, "the corners here and at the next waypoint need " + format_double(needed) + " m of the " +
                        format_double(corners.lengths[i]) + " m between them; corner_radius_m is too large"};
  }
  return std::nullopt;
}

RoundedPolyline::RoundedPolyline(std::span<const Vec3> waypoints, bool closed, double corner_radius_m)
    : closed_(closed) {
  const std::size_t count = waypoints.size();
  const Corners corners = measure(waypoints, closed, corner_radius_m);
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

double RoundedPolyline::on_path(double distance_m) const {
  if (!closed_) return std::clamp(distance_m, 0.0, length_m_);
  const double distance = std::fmod(distance_m, length_m_);
  return distance < 0.0 ? distance + length_m_ : distance;
}

std::vector<double> RoundedPolyline::jumps_m() const {
  std::vector<double> jumps;
  for (const Piece& piece : pieces_) jumps.push_back(piece.begin_m);
  jumps.push_back(length_m_);
  jumps.erase(std::unique(jumps.begin(), jumps.end()), jumps.end());
  return jumps;
}

CurvePoint RoundedPolyline::point(double distance_m, CurveSide side) const {
  const double distance = on_path(distance_m);
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
  const double distance = on_path(distance_m);
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
