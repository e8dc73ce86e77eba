// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "bsp/sweep.hpp"

namespace hallway::bsp {

/// Parameters of slide().
struct SlideOptions {
  int most_contacts = 8;  ///< the body stops at the one with this number
  double step_m = 0.0;    ///< height of steps that the body climbs; 0 for none
  double floor_z =
      0.7;  ///< upward part of the normal from which on a face is a floor that the body may step onto
};

/// Where a body came by sliding.
struct SlideResult {
  Vec3 position = Vec3::Zero();         ///< metres
  std::vector<BodyContact> contacts{};  ///< in the order in which they were met
  bool starts_in_solid = false;         ///< it then stays where it is
};

/// Moves a body towards a point; where it is stopped it goes on along the face that stops it, between two faces along their
/// common direction, and stops in corners. It never turns back, and what it travels altogether is not longer than the way that was
/// asked for, but for steps and the clearance (sweep_body()).
///
/// With step_m it tries, where something steep is in its way, to go over it: up, onward, down by as much as it went up. It takes
/// that if it gets farther in the level and does not come down on a slope that is no floor.
///
/// Throws as sweep_body() does, and Error{kBadInput} for a step_m that is negative or no number.
SlideResult slide(const Tree& tree, const csg::Surface& surface, const Vec3& from, const Vec3& to,
                  const Body& body, const SlideOptions& options = {});

}  // namespace hallway::bsp
