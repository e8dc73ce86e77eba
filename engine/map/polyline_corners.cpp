// SPDX-License-Identifier: MIT
#include "map/polyline_corners.hpp"

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

std::size_t line_count(std::size_t waypoints, bool closed) {
  return closed ? waypoints : waypoints - 1;
}

}  // namespace

PolylineCorners measure_corners(std::span<const Vec3> waypoints, bool closed, double radius) {
  const std::size_t count = waypoints.size();
  PolylineCorners corners;
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

std::optional<PolylineFault> check_polyline(std::span<const Vec3> waypoints, bool closed, double radius) {
  const std::size_t count = waypoints.size();
  const std::size_t least = closed ? 3 : 2;
  if (count < least) {
    return PolylineFault{0, "the path has " + std::to_string(count) + " waypoints; it needs at least " +
                                std::to_string(least)};
  }
  for (std::size_t i = 0; i < line_count(count, closed); ++i) {
    const Vec3 step = waypoints[(i + 1) % count] - waypoints[i];
    if (step.norm() < kSamePlace_m) return PolylineFault{i, "the next waypoint is at the same place"};
    if (step.head<2>().norm() < kVertical * step.norm())
      return PolylineFault{i, "the way to the next waypoint is vertical"};
  }
  const PolylineCorners corners = measure_corners(waypoints, closed, radius);
  for (std::size_t i = 0; i < count; ++i) {
    if (corners.turns[i] > std::numbers::pi - kTurnBack)
      return PolylineFault{i, "the path turns straight back here"};
  }
  for (std::size_t i = 0; i < line_count(count, closed); ++i) {
    const double needed = corners.trims[i] + corners.trims[(i + 1) % count];
    constexpr double kRounding = 1e-9;
    if (needed <= corners.lengths[i] * (1.0 + kRounding)) continue;
    return PolylineFault{i, "the corners here and at the next waypoint need " + format_double(needed) +
                                " m of the " + format_double(corners.lengths[i]) +
                                " m between them; corner_radius_m is too large"};
  }
  return std::nullopt;
}

double distance_within(double distance_m, double length_m, bool closed) {
  if (!closed) return std::clamp(distance_m, 0.0, length_m);
  const double distance = std::fmod(distance_m, length_m);
  return distance < 0.0 ? distance + length_m : distance;
}

}  // namespace hallway::map
