// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geometry/se3.hpp"
#include "map/curve_point.hpp"

namespace hallway::map {

/// Straight lines between waypoints whose corners are arcs of a circle, so that the direction never jumps.
class RoundedPolyline {
 public:
  /// @param waypoints        world, metres; must pass check_polyline()
  /// @param corner_radius_m  greater than 0
  RoundedPolyline(std::span<const Vec3> waypoints, bool closed, double corner_radius_m);

  double length_m() const { return length_m_; }
  bool closed() const { return closed_; }
  /// T_world_body. Distance 0 is the first waypoint; where a closed path has a corner there, the end of that corner's arc.
  Pose at(double distance_m) const;
  /// The same point with derivatives. Where an arc begins or ends the curvature jumps.
  CurvePoint point(double distance_m, CurveSide side) const;
  /// Where it does, ascending, within [0, length]; of an open path with both ends.
  std::vector<double> jumps_m() const;

 private:
  /// A straight line, or an arc where `radius_m` is positive.
  struct Piece {
    double begin_m = 0.0;  ///< distance from the start of the path
    double length_m = 0.0;
    Vec3 start = Vec3::Zero();
    Vec3 direction = Vec3::UnitX();  ///< at its start
    Vec3 inward = Vec3::Zero();      ///< from the start towards the arc's centre, unit length
    double radius_m = 0.0;
  };

  void append(Piece piece);

  std::vector<Piece> pieces_;
  double length_m_ = 0.0;
  bool closed_;
};

}  // namespace hallway::map
