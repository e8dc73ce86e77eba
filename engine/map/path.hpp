// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "geometry/se3.hpp"
#include "map/curve_point.hpp"
#include "map/document.hpp"
#include "map/lemniscate.hpp"
#include "map/rounded_polyline.hpp"
#include "map/smooth_polyline.hpp"

namespace hallway::map {

/// What is made of the corners between the lines of a path of waypoints.
enum class CornerShape {
  kArcs,   ///< RoundedPolyline
  kSmooth  ///< SmoothPolyline
};

/// A way through the world, parametrised by the distance travelled.
class Path {
 public:
  explicit Path(RoundedPolyline curve) : curve_(std::move(curve)) {}
  explicit Path(SmoothPolyline curve) : curve_(std::move(curve)) {}
  explicit Path(Lemniscate curve) : curve_(std::move(curve)) {}

  /// Length of the whole path, of one round where it is closed; metres.
  double length_m() const;
  bool closed() const;
  /// T_world_body after `distance_m` metres: x forward along the path including its incline, y level. Beyond the ends a
  /// closed path goes on round, an open one stands at its end. O(log of the number of pieces).
  Pose at(double distance_m) const;
  /// The same point with derivatives by the distance, of one side where they jump. Beyond the ends of an open path those of its end.
  CurvePoint point(double distance_m, CurveSide side) const;
  /// The distances in (from, to] at which a derivative jumps, ascending: where corners begin and end; of an open path its ends too. Of
  /// smooth corners those that jump are beyond the ones of CurvePoint.
  std::vector<double> jumps_in(double from_m, double to_m) const;

 private:
  std::variant<RoundedPolyline, SmoothPolyline, Lemniscate> curve_;
};

/// The names of the map's paths, in the order of the file. Throws Error{kBadInput} for a path without a name.
std::vector<std::string> path_names(const Document& document);

/// The path that the entity `hw_path` of that name describes (entities and keys: docs/formats.md).
/// Throws Error{kBadInput}: no such path (naming those that exist), two of one name, a key missing or out of range, too few
/// waypoints, a corner that leaves its arc no room.
Path find_path(const Document& document, std::string_view name, CornerShape corners = CornerShape::kArcs);

}  // namespace hallway::map
