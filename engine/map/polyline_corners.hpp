// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::map {

/// A waypoint at which no path can be made, and why.
struct PolylineFault {
  std::size_t waypoint;
  std::string message;
};

/// The lines between waypoints and what arcs at their ends take from them.
struct PolylineCorners {
  std::vector<Vec3> directions;  ///< of line i, from waypoint i to the next
  std::vector<double> lengths;
  std::vector<double> turns;  ///< at waypoint i, radians; 0 at the ends of an open path
  std::vector<double> trims;  ///< what the arc at waypoint i takes from each of its lines, metres
};

/// @param radius  of the arcs, metres
PolylineCorners measure_corners(std::span<const Vec3> waypoints, bool closed, double radius);

/// Says what is wrong with the waypoints, if anything: too few (2, or 3 if closed), two at one place, a turn straight
/// back, a vertical line, a corner whose arc needs more of its lines than there is.
std::optional<PolylineFault> check_polyline(std::span<const Vec3> waypoints, bool closed, double radius);

/// A distance as one from 0 to the length: of a closed path by whole rounds, of an open one clamped.
double distance_within(double distance_m, double length_m, bool closed);

}  // namespace hallway::map
