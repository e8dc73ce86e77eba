// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "bsp/body.hpp"
#include "bsp/tree.hpp"
#include "csg/surface.hpp"

namespace hallway::bsp {

/// Bodies are kept this far from the surface, metres.
inline constexpr double kClearance = 1e-6;

/// What a body meets.
struct BodyContact {
  Vec3 normal = Vec3::
      UnitZ();  ///< unit; from the surface to the body: that of the face, or between those of the faces at an edge
  std::uint32_t polygon =
      0;  ///< of the surface; the one with the lowest number where several are met at once
};

/// How far a body came.
struct SweepResult {
  Vec3 position = Vec3::Zero();          ///< of the body where it stops, metres
  double fraction = 1.0;                 ///< of the way, in [0, 1]
  std::optional<BodyContact> contact{};  ///< what stops it; none if it came all the way
  bool starts_in_solid = false;          ///< overlaps solid by more than kClearance, and stays where it is
  bool starts_in_contact = false;        ///< touches the surface, within kClearance, at the start
};

/// Moves a body along a straight line, continuously, up to the first contact.
///
/// The body never gets nearer to the surface than half of kClearance, and ends kClearance away from what it meets, as far as its way back allows. One that
/// starts closer than that, or up to kClearance deep in the surface, is first put kClearance away from it, and its whole way with it;
/// where there is no room for that, as in a gap of its own width, it starts where it is. It then may leave what it touches and
/// run along it. Only faces that it moves against stop it.
///
/// A ball and a box are exact; a cylinder is exact against faces, and counts as up to 0.22 % of its radius larger where it meets upright and sloping edges
/// or corners. What is said of kClearance holds to rounding, and in maps of up to 0.1 m per unit (csg::kWeldDistance).
///
/// @param surface  the one that the tree was made with
/// Throws Error{kBadInput} as check_body() and check_query_point() do. O(depth + what lies near the way). Any number of threads may ask at once.
SweepResult sweep_body(const Tree& tree, const csg::Surface& surface, const Vec3& from, const Vec3& to,
                       const Body& body);

/// sweep_body() of a ball about its centre.
inline SweepResult sweep_sphere(const Tree& tree, const csg::Surface& surface, const Vec3& from,
                                const Vec3& to, double radius_m) {
  return sweep_body(tree, surface, from, to, Sphere{radius_m});
}

}  // namespace hallway::bsp
