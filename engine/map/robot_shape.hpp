// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geom/plane.hpp"
#include "map/document.hpp"

namespace hallway::map {

/// The body of a robot file: a convex polyhedron or an upright cylinder about the z axis. Body frame, metres.
struct RobotBody {
  std::vector<Vec3> vertices{};                     ///< empty for a cylinder
  std::vector<std::vector<std::uint32_t>> sides{};  ///< loops of vertices, counter-clockwise from outside
  std::vector<Plane> planes{};                      ///< of the sides, outward
  double radius_m = 0.0;                            ///< 0 for a polyhedron
  double bottom_m = 0.0;                            ///< lowest z
  double top_m = 0.0;                               ///< highest z
  int line = 0;

  bool is_cylinder() const { return radius_m > 0.0; }
};

/// A part of a body's surface that feels contact: what of the surface is in a sector about the body's z axis and a range of heights, or
/// inside of a convex region. Body frame.
struct BumpZone {
  std::string name{};
  std::vector<Plane> region{};  ///< outward; empty for a sector
  double from_rad = 0.0;  ///< the sector goes counter-clockwise from here, 0 forward, positive to the left
  double to_rad = 0.0;    ///< above from_rad, at most a full turn
  double bottom_m = 0.0;
  double top_m = 0.0;
  int line = 0;

  /// Whether a point of the body's surface is in the zone; its borders are. O(planes).
  bool contains(const Vec3& point_m) const;
};

/// The one body of a document: a brush of worldspawn or of a `func_group`, or an `hw_body`. Throws Error{kBadInput} with file, line and cause
/// for none, more than one, and one that is no body, thinner than 1 mm or farther than 100 m from the origin.
RobotBody robot_body(const Document& document);

/// How far a point is beside the outline of the body as seen from above; 0 over it, under it and in it. Metres. O(n log n) in the corners.
double distance_beside(const RobotBody& body, const Vec3& point_m);

/// The zones `hw_bump_zone` in the order of the file. Throws Error{kBadInput} for a bad key, two of one name, more than 64, and a zone that has
/// no part of the body's surface.
std::vector<BumpZone> bump_zones(const Document& document, const RobotBody& body);

}  // namespace hallway::map
