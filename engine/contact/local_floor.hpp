// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "contact/obstacles.hpp"
#include "geometry/convex2.hpp"

namespace hallway::contact {

/// Heights above the plane that a body stands on, metres. A body is replaced by an upright prism.
struct FloorBands {
  double body_low = 0.0;
  double body_high = 0.0;  ///< what is between is in the body's way
  double wall_low = 0.0;   ///< what is between is in its way even if the floor lifts, lowers or tilts it
  double wall_high = 0.0;  ///< below `wall_low`: not asked
  double wheel_down = 0.0;
  double wheel_up = 0.0;  ///< how far below and above a wheel looks for its floor
  double flat = 0.0;      ///< what is nearer to the plane is in it
};

/// What is around a place on a floor, seen from above on the plane of the floor there: in the plane's frame, whose origin is the place.
///
/// Its answers are conservative: what it calls free or flat, is so.
class LocalFloor {
 public:
  /// @param frame  T_world_plane: x is above the world's x axis, z is the plane's normal
  /// @param range  how far from the origin answers are wanted, metres
  LocalFloor(const Obstacles& obstacles, const FloorBands& bands, const Pose& frame, double range);

  /// Whether the plane is the floor of every wheel in an area: triangles in it cover the area, and nothing rises from it within reach.
  bool is_flat(const Convex& area) const;
  /// Whether nothing in the body's way is within 1 mm of an area.
  bool is_free(const Convex& area) const { return is_apart(body_, area); }
  /// Whether nothing in the body's way is within `radius` and 1 mm of a segment.
  bool is_free(const Vec2& a, const Vec2& b, double radius) const;
  /// Whether something blocks an area whatever the floor does there.
  bool has_wall(const Convex& area) const { return !is_apart(walls_, area); }

 private:
  static bool is_apart(const std::vector<Convex>& shapes, const Convex& area);

  std::vector<Convex> body_, walls_, bumps_, ground_;
};

/// A regular polygon of 16 corners about the circle of a radius.
Convex round_area(double radius);

/// The hull of an area and the same area moved.
Convex swept(const Convex& area, const Vec2& by);

}  // namespace hallway::contact
