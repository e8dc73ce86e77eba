// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "eval/floor_plan.hpp"
#include "geometry/convex2.hpp"

namespace hallway::eval {

/// A gap between two walls, as a robot meets it that follows the first of them.
struct Opening {
  std::size_t wall = 0;  ///< that ends at it
  std::size_t far_wall = 0;
  double far_along_m = 0.0;  ///< where on the far wall it ends, from that wall's start
  Vec2 from = Vec2::Zero();  ///< the end of `wall`
  Vec2 to = Vec2::Zero();    ///< the place on the far wall

  double width_m() const { return (to - from).norm(); }
};

/// Whether the boundary goes away from the robot's side, or back, at a wall's end. What goes away or stands out by no more than `depth_m`, as a
/// door frame does, does not count. O(walls).
bool opens_at_end(const FloorPlan& plan, std::size_t wall, double depth_m);

/// The opening at a wall's end, if the wall goes on in line: the nearest wall, no more than `widest_m` ahead, that reaches into the strip from
/// `aside_m` behind the wall's line to `aside_m` in front of it. Beside a wall in line this may be a wall ahead. Empty where there is
/// none. O(segments).
std::optional<Opening> find_opening(const FloorPlan& plan, std::size_t wall, double widest_m, double aside_m);

/// What is behind an opening.
enum class Behind : std::uint8_t {
  kRoom,
  kHallway,
};

/// The region behind an opening: the boundary from its first edge to its last, counter-clockwise. Empty where that boundary does not come
/// back to the opening, which then is not the only way out. O(walls).
std::vector<Vec2> region_behind(const FloorPlan& plan, const Opening& opening);

/// The share of a region that is seen from the middle of the opening, which is the edge from its last point to its first.
/// @param region  counter-clockwise, of an area above 0. O(n^2)
double seen_share(const std::vector<Vec2>& region);

/// A room is a region with one opening, of which at least 0.6 is seen from there, which is at most 2.5 times as deep as wide and at most 4 times as
/// wide as deep, the width being along the wall: a cubicle of double width is a room. All else is a hallway. What is free of the walls within it does
/// not count.
Behind what_is_behind(const FloorPlan& plan, const Opening& opening);

}  // namespace hallway::eval
