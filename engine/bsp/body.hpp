// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "geometry/se3.hpp"

namespace hallway::bsp {

/// A ball; its position is its centre.
struct Sphere {
  double radius_m = 0.0;
};

/// An upright cylinder about the vertical through its position. A robot whose position is the floor under it has z_low_m = 0.
struct Cylinder {
  double radius_m = 0.0;
  double z_low_m = 0.0;  ///< of its bottom above the position
  double z_high_m = 0.0;
};

/// An upright box whose middle lies on the vertical through its position.
struct UprightBox {
  double half_length_m = 0.0;  ///< along its heading
  double half_width_m = 0.0;
  double yaw_rad = 0.0;  ///< from the x axis to its heading, about z
  double z_low_m = 0.0;  ///< of its bottom above the position
  double z_high_m = 0.0;
};

/// What is moved through a world. It does not turn on its way.
using Body = std::variant<Sphere, Cylinder, UprightBox>;

/// Lengths that a body may have: radius, half length, half width and height in metres. Its bottom and top may lie kGreatestBodySize
/// from its position.
inline constexpr double kLeastBodySize = 1e-4;
inline constexpr double kGreatestBodySize = 1e4;

/// Throws Error{kBadInput} for a body with a size that is out of range or no number.
void check_body(const Body& body);

}  // namespace hallway::bsp
