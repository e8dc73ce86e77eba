// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "wall_follower/core/angles.hpp"
#include "wall_follower/core/odometer.hpp"
#include "wall_follower/core/options.hpp"

namespace hallway::wall_follower {

/// A point of the wall, as the detector to the right saw it.
struct WallPoint {
  Vec2 at = Vec2::Zero();    ///< in the frame of Odometer::reckoned()
  double way_m = 0.0;        ///< Odometer::way_m() at that time
  std::int64_t t_ns = 0;     ///< of the frame
  Place from;                ///< Odometer::charted() then
  Vec2 body = Vec2::Zero();  ///< the point in the body frame then
};

/// A discontinuity of the wall: from some point on it is nearer or farther.
struct Step {
  int direction = 0;    ///< +1: the wall goes on farther from the robot; -1: nearer
  double size_m = 0.0;  ///< at least 0
  WallPoint at;         ///< the first point behind it
};

/// The wall on the robot's right as a line through the recent points of it, and its discontinuities. Before there are enough points the line is where the wall is
/// expected to be.
class Wall {
 public:
  explicit Wall(const Options& options) : options_(options) {}

  /// Begins a wall of which a point and the direction are expected, in the frame of Odometer::reckoned().
  void expect(const Vec2& at, double direction);
  /// Takes a point. @return the discontinuity that is certain now
  std::optional<Step> add(const WallPoint& point);
  /// Forgets points that are not yet certain to be behind a discontinuity.
  void drop_pending() { pending_.clear(); }

  /// Direction of the wall, which has the robot on its left [rad].
  double direction() const { return direction_; }
  /// Distance of the line from a point to the left of it [m].
  double distance(const Vec2& from) const;
  /// From the wall's direction to the robot's, left positive [rad].
  double slant(const Place& robot) const { return wrapped(robot.heading - direction_); }
  /// Whether the line goes through enough points to tell its direction.
  bool is_measured() const { return extent() >= 0.6 * options_.fit_m; }
  /// Whether there are any points of it.
  bool has_points() const { return points_.size() >= 3; }
  const WallPoint& last() const { return points_.back(); }

 private:
  /// How far the point is behind the line, as seen from the robot [m].
  double behind(const Vec2& point) const;
  double extent() const;
  void fit();

  Options options_;
  Vec2 at_ = Vec2::Zero();
  double direction_ = 0.0;
  double expected_ = 0.0;          // direction of which the fit is a correction
  std::deque<WallPoint> points_;   // of the last fit_m
  std::deque<WallPoint> pending_;  // behind what may be a discontinuity
};

}  // namespace hallway::wall_follower
