// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/intervals.hpp"
#include "geometry/se3.hpp"
#include "sense/wall_plan.hpp"

namespace hallway::sense {

/// What of a plan a sensor sees, and how.
struct WallViewSpec {
  double horizontal_fov = 0.5 * 3.14159265358979323846;  ///< full angle, radians, above 0 and up to 2 pi
  double min_range_m = 0.0;                              ///< inclusive
  double max_range_m = 12.0;                             ///< inclusive
  /// The ranges are distances from the sensor. Else they are depths, along the line of sight, and at the sides farther away (thesis
  /// 4.3.6, "frustum failure"). From 180 degrees on they are distances in any case.
  bool bounded_sides = false;
  bool occlusion = true;       ///< what is nearer hides what is farther
  double min_length_m = 0.05;  ///< shorter pieces are not seen
};

/// A part of a wall that is seen.
struct VisibleWall {
  std::uint32_t wall = 0;  ///< index in WallPlan::walls
  std::uint32_t part = 0;  ///< counts the pieces of this wall in this view, from its left
  /// Its ends in the sensor's frame, metres; the empty side is to the sensor.
  Vec2 left = Vec2::Zero();
  Vec2 right = Vec2::Zero();
};

struct WallLine;

/// Finds what is seen of walls in the horizontal plane of their plan, exactly: where the border of the view, a circle of a range and
/// the shadow of every obstacle meet the wall is computed, and no rays are sampled. A wall is seen from its empty side alone (thesis
/// 4.3.2, Rule 10).
class WallView {
 public:
  /// Keeps a reference to `plan`, which must outlive it.
  WallView(const WallViewSpec& spec, const WallPlan& plan);

  /// Replaces `pieces` by what is seen, in the order of the walls and from left to right. O(obstacles in view * walls in view +
  /// obstacles). An end of a wall that is seen is given bit by bit as it is, whatever touches it.
  /// @param position  world, metres
  /// @param forward   the line of sight, unit
  void find(const Vec2& position, const Vec2& forward, std::vector<VisibleWall>& pieces) const;

 private:
  bool may_hide(const Obstacle& obstacle) const;
  Interval in_view(const WallLine& line) const;
  void add_out_of_view(const WallLine& line, std::vector<Interval>& taken) const;
  void find_on(const WallLine& line, std::uint32_t wall, std::span<const Obstacle> obstacles,
               std::vector<VisibleWall>& pieces) const;

  WallViewSpec spec_;
  const WallPlan& plan_;
  bool wide_;         ///< 180 degrees or more
  bool round_;        ///< the ranges are distances
  double reach_m_;    ///< the farthest distance of a point in view
  Vec2 left_inward_;  ///< normals of the borders of the view, inward
  Vec2 right_inward_;
};

}  // namespace hallway::sense
