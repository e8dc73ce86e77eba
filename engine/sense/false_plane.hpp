// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "geom/plane_observation.hpp"
#include "sense/detection.hpp"
#include "sense/field_of_view.hpp"

namespace hallway::sense {

/// Where false planes are, and how large.
struct FalsePlaneSpec {
  FieldOfView view{1.0, 1.0, 0.0, 1.0};
  bool depths = true;         ///< the ranges are along the line of sight, not distances
  double min_length_m = 0.0;  ///< no false plane is shorter
};

/// An upright rectangle at the sensor's height. Its middle is in a direction of direction_in() and at a depth or distance uniform in the range. It is
/// turned from the line of sight by up to 60 degrees; its length is uniform over 2 m from the least one on, its height 2 m. A pure function
/// of the arguments; sensor frame.
/// @param element  which false one of the reading
PlaneObservation false_wall(const Detection& detection, const FalsePlaneSpec& spec, std::uint32_t reading,
                            std::uint32_t element);

/// A square in any plane, likewise; its edges are in any direction of the plane.
PlaneObservation false_face(const Detection& detection, const FalsePlaneSpec& spec, std::uint32_t reading,
                            std::uint32_t element);

}  // namespace hallway::sense
