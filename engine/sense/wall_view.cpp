// SPDX-License-Identifier: MIT
#include "sense/wall_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace hallway::sense {

/// A wall in the sensor's frame, measured from its left end along it, and from it towards the sensor.
struct WallLine {
  WallLine(const Vec2& left_end, const Vec2& right_end)
      : left(left_end),
        right(right_end),
        length_m((right - left).norm()),
        along((right - left) / length_m),
        normal(along.y(), -along.x()),
        foot_m(-along.dot(left)),
        distance_m(-normal.dot(left)) {}

  Vec2 left, right;
  double length_m;
  Vec2 along;         ///< unit, from left to right
  Vec2 normal;        ///< unit, into the empty side
  double foot_m;      ///< where the sensor stands along it
  double distance_m;  ///< of the sensor, above 0 on the empty side

  /// A point along the wall; at its ends the ends themselves.
  Vec2 at(double u_m) const {
    if (u_m <= 0.0) return left;
    if (u_m >= length_m) return right;
    return left + u_m * along;
  }
};

namespace {

using std::numbers::pi;
constexpr double kViewAngleRounding = 1e-9;  ///< radians
constexpr double kLeastDistance_m = 1e-6;    ///< from the plane of a wall, to see it at all
constexpr double kOnWall_m =
    1e-7;  ///< what does not stand out of a wall's plane farther than this hides nothing of it
constexpr double kSameEnd_m = 1e-9;  ///< a piece that ends this near to the wall's end ends there
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Where the ray from the sensor through a point meets the line of a wall.
/// @param u, v  the point along the wall and towards the sensor, 0 <= v <= distance_m
double project(const WallLine& line, double u, double v) {
  const double sideways = u - line.foot_m, left_over = line.distance_m - v;
  if (left_over > 0.0) return line.foot_m + sideways * (line.distance_m / left_over);
  return sideways < 0.0 ? -kInfinity : kInfinity;
}

/// What an obstacle hides of the line of a wall; nothing if it does not stand between the wall and the sensor.
std::optional<Interval> shadow(const WallLine& line, const Obstacle& obstacle) {
  double u0 = line.along.dot(obstacle.from - line.left), v0 = line.normal.dot(obstacle.from - line.left);
  double u1 = line.along.dot(obstacle.to - line.left), v1 = line.normal.dot(obstacle.to - line.left);
  if (v0 > v1) {
    std::swap(u0, u1);
    std::swap(v0, v1);
  }
  if (v1 <= kOnWall_m || v0 >= line.distance_m) return std::nullopt;
  const double slope = v1 > v0 ? (u1 - u0) / (v1 - v0) : 0.0;
  const double u_low = v0 < 0.0 ? u0 - v0 * slope : u0;
  const double u_high = v1 > line.distance_m ? u0 + (line.distance_m - v0) * slope : u1;
  const double a = project(line, u_low, std::max(v0, 0.0));
  const double b = project(line, u_high, std::min(v1, line.distance_m));
  return Interval{std::min(a, b), std::max(a, b)};
}

/// Where the line is within a distance of the sensor.
Interval within(const WallLine& line, double range_m) {
  const double square = range_m * range_m - line.distance_m * line.distance_m;
  if (square < 0.0) return {0.0, 0.0};
  const double half = std::sqrt(square);
  return {line.foot_m - half, line.foot_m + half};
}

double distance_of(const Obstacle& obstacle) {
  const Vec2 way = obstacle.to - obstacle.from;
  const double square = way.squaredNorm();
  const double share = square > 0.0 ? std::clamp(-way.dot(obstacle.from) / square, 0.0, 1.0) : 0.0;
  return (obstacle.from + share * way).norm();
}

}  // namespace

WallView::WallView(const WallViewSpec& spec, const WallPlan& plan)
    : spec_(spec),
      plan_(plan),
      wide_(spec.horizontal_fov >= pi - kViewAngleRounding),
      round_(spec.bounded_sides || wide_) {
  const double half = std::min(0.5 * spec.horizontal_fov, pi);
  reach_m_ = round_ ? spec.max_range_m : spec.max_range_m / std::cos(half);
  left_inward_ = Vec2(std::sin(half), -std::cos(half));
  right_inward_ = Vec2(std::sin(half), std::cos(half));
}

bool WallView::may_hide(const Obstacle& obstacle) const {
  if (!wide_) {
    for (const Vec2& inward : {left_inward_, right_inward_}) {
      if (inward.dot(obstacle.from) < 0.0 && inward.dot(obstacle.to) < 0.0) return false;
    }
  }
  return distance_of(obstacle) <= reach_m_;
}

/// What of a wall is in view, but for what add_out_of_view() takes.
Interval WallView::in_view(const WallLine& line) const {
  Interval interval{0.0, line.length_m};
  if (!wide_) {
    for (const Vec2& inward : {left_inward_, right_inward_})
      keep_where_positive(interval, inward.dot(line.left), inward.dot(line.along));
  }
  if (round_) {
    const Interval near = within(line, spec_.max_range_m);
    return {std::max(interval.from, near.from), std::min(interval.to, near.to)};
  }
  keep_where_positive(interval, line.left.x() - spec_.min_range_m, line.along.x());
  keep_where_positive(interval, spec_.max_range_m - line.left.x(), -line.along.x());
  return interval;
}

/// The parts of a wall that are out of view within it: too near, or behind a sensor that sees all but that.
void WallView::add_out_of_view(const WallLine& line, std::vector<Interval>& taken) const {
  if (round_) taken.push_back(within(line, spec_.min_range_m));
  if (!wide_ || spec_.horizontal_fov >= 2.0 * pi - kViewAngleRounding) return;
  Interval behind{-kInfinity, kInfinity};
  for (const Vec2& inward : {left_inward_, right_inward_})
    keep_where_positive(behind, -inward.dot(line.left), -inward.dot(line.along));
  taken.push_back(behind);
}

void WallView::find(const Vec2& position, const Vec2& forward, std::vector<VisibleWall>& pieces) const {
  const auto to_sensor = [&](const Vec2& point) {
    const Vec2 way = point - position;
    return Vec2(forward.dot(way), forward.x() * way.y() - forward.y() * way.x());
  };
  std::vector<Obstacle> obstacles;
  if (spec_.occlusion) {
    for (const Obstacle& obstacle : plan_.obstacles) {
      const Obstacle seen{to_sensor(obstacle.from), to_sensor(obstacle.to)};
      if (may_hide(seen)) obstacles.push_back(seen);
    }
  }
  pieces.clear();
  for (std::size_t i = 0; i < plan_.walls.size(); ++i) {
    const WallLine line(to_sensor(plan_.walls[i].left), to_sensor(plan_.walls[i].right));
    if (line.distance_m >= kLeastDistance_m) find_on(line, static_cast<std::uint32_t>(i), obstacles, pieces);
  }
}

void WallView::find_on(const WallLine& line, std::uint32_t wall, std::span<const Obstacle> obstacles,
                       std::vector<VisibleWall>& pieces) const {
  const Interval all = in_view(line);
  if (!(all.from < all.to)) return;
  std::vector<Interval> kept{all}, taken;
  add_out_of_view(line, taken);
  for (const Obstacle& obstacle : obstacles) {
    if (const auto hidden = shadow(line, obstacle)) taken.push_back(*hidden);
  }
  subtract(kept, taken);
  std::uint32_t part = 0;
  for (const Interval& seen : kept) {
    const double from = seen.from < kSameEnd_m ? 0.0 : seen.from;
    const double to = seen.to > line.length_m - kSameEnd_m ? line.length_m : seen.to;
    if (to - from >= spec_.min_length_m) pieces.push_back({wall, part++, line.at(from), line.at(to)});
  }
}

}  // namespace hallway::sense
