// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/se3.hpp"
#include "map/curve_point.hpp"
#include "map/polyline_pieces.hpp"

namespace hallway::map {

/// A curve that turns from one straight line into another, with a curvature that begins and ends at 0, as its slope does. At the part u of its length
/// its direction has turned by turn * (6 u^5 - 15 u^4 + 10 u^3). In a plane: it begins at 0 along x, and turns towards y.
class CornerBlend {
 public:
  /// @param turn    radians, above 0 and below pi
  /// @param trim_m  from its begin to the corner of the two lines
  CornerBlend(double turn, double trim_m);

  double length_m() const { return length_m_; }
  /// @param along_m  within [0, length]
  Vec2 position(double along_m) const;
  /// Direction of the curve, and its derivatives by the length.
  struct Heading {
    double angle = 0.0, curvature = 0.0, slope = 0.0;
  };
  Heading heading(double along_m) const;

 private:
  static constexpr std::size_t kCells = 16;

  Vec2 unit_step(double from, double to) const;

  double turn_;
  std::array<Vec2, kCells + 1> nodes_;  ///< of the curve of length 1
  double length_m_;
};

/// Straight lines between waypoints whose corners are CornerBlends, which begin and end where the arcs of a RoundedPolyline do. Position, direction,
/// curvature and its slope never jump. At a corner the curve is between the arc and the waypoint; its greatest curvature is less than twice the arc's.
class SmoothPolyline {
 public:
  /// @param waypoints        world, metres; must pass check_polyline()
  /// @param corner_radius_m  of the arcs, greater than 0
  SmoothPolyline(std::span<const Vec3> waypoints, bool closed, double corner_radius_m);

  double length_m() const { return pieces_.length_m(); }
  bool closed() const { return pieces_.closed(); }
  /// T_world_body. Distance 0 is the first waypoint; where a closed path has a corner there, the end of that corner's curve.
  Pose at(double distance_m) const;
  /// The same point with derivatives. The position is right to 1e-12 of the corner's size.
  CurvePoint point(double distance_m) const;
  /// Where a higher derivative jumps, ascending: where corners begin and end; the ends of the path too.
  std::vector<double> jumps_m() const { return pieces_.joints_m(); }

 private:
  PolylinePieces<CornerBlend> pieces_;
};

}  // namespace hallway::map
