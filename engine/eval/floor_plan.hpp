// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::eval {

/// A straight piece of the boundary of free space. Free space is on the left of the way from `from` to `to`. World frame, metres.
struct PlanSegment {
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
};

/// Segments that follow each other without a corner: a robot with the wall on its right drives along it from the first point to the last.
struct PlanWall {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  std::vector<Vec2> points;  ///< at least two, world frame, metres
  double length_m = 0.0;
  std::size_t bend = 0;      ///< how many of its first segments are the round edge of a corner
  double bend_m = 0.0;       ///< their length
  std::size_t next = kNone;  ///< the wall that begins at its end; itself where it is closed and has no corner

  const Vec2& start() const { return points.front(); }
  const Vec2& end() const { return points.back(); }
  /// Unit vectors along its first segment after the bend, and its last one.
  Vec2 start_direction() const { return (points[bend + 1] - points[bend]).normalized(); }
  Vec2 end_direction() const { return (points.back() - points[points.size() - 2]).normalized(); }
};

/// A plan of the walls at one height: the boundary of free space as walls that are joined at corners.
class FloorPlan {
 public:
  /// Least turn between two segments that is a corner; arcs are made of smaller ones.
  static constexpr double kCorner_rad = 0.5;
  /// Right turns one after the other are the round or bevelled edge of one corner, where they are together at least that much and over at most that
  /// length. The wall behind the corner begins with them.
  static constexpr double kBend_rad = 1.0;
  static constexpr double kBend_m = 1.0;

  /// Where a ray meets a wall.
  struct Hit {
    std::size_t wall = 0;  ///< index in walls()
    double range_m = 0.0;
    double along_m = 0.0;           ///< from the wall's start
    Vec2 direction = Vec2::Zero();  ///< unit, of the segment
  };

  /// Joins the segments whose ends are the same to the last bit; segments without length are left out. Where several boundaries touch in
  /// a point, each goes on round the same free space. O(n log n).
  explicit FloorPlan(std::span<const PlanSegment> segments);

  /// In the order of the segments that they begin with.
  const std::vector<PlanWall>& walls() const { return walls_; }

  /// The first wall that a ray meets from its free side. O(segments).
  /// @param direction  unit
  std::optional<Hit> first_hit(const Vec2& from, const Vec2& direction, double reach_m) const;

 private:
  struct Piece {
    Vec2 from, to;
    std::size_t wall;
    double along_m;  ///< of `from`
  };

  std::vector<PlanWall> walls_;
  std::vector<Piece> pieces_;
};

}  // namespace hallway::eval
