// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geometry/se3.hpp"
#include "map/curve_point.hpp"
#include "map/polyline_pieces.hpp"

namespace hallway::map {

/// Straight lines between waypoints whose corners are arcs of a circle, so that the direction never jumps.
class RoundedPolyline {
 public:
  /// @param waypoints        world, metres; must pass check_polyline()
  /// @param corner_radius_m  greater than 0
  RoundedPolyline(std::span<const Vec3> waypoints, bool closed, double corner_radius_m);

  double length_m() const { return pieces_.length_m(); }
  bool closed() const { return pieces_.closed(); }
  /// T_world_body. Distance 0 is the first waypoint; where a closed path has a corner there, the end of that corner's arc.
  Pose at(double distance_m) const;
  /// The same point with derivatives. Where an arc begins or ends the curvature jumps.
  CurvePoint point(double distance_m, CurveSide side) const;
  /// Where it does, ascending, within [0, length]; of an open path with both ends.
  std::vector<double> jumps_m() const { return pieces_.joints_m(); }

 private:
  struct Arc {
    double radius_m;
    double turn;  ///< radians
    double length_m() const { return radius_m * turn; }
  };

  PolylinePieces<Arc> pieces_;
};

}  // namespace hallway::map
