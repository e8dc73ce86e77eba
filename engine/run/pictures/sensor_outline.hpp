// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/se3.hpp"
#include "render/picture.hpp"
#include "sim/scenario.hpp"

namespace hallway::run {

/// What all kinds of sensors that look have.
struct FieldOfView {
  std::string name;
  Pose T_body_sensor;
  double horizontal = 0.0, vertical = 0.0;  ///< full angles, rad
  double range_m = 0.0;
  /// Closed outlines of several beams, or of beams that are no sectors, in the sensor's level plane; empty: the sector of the angles.
  std::vector<std::vector<Vec2>> beams{};
};

/// Nothing for a sensor that does not look: a bumper, encoders.
std::optional<FieldOfView> field_of(const sim::SensorSpec& sensor);

/// The level middle of a field of view, the first with what it is as label.
/// @param longest_m  a longer one is drawn smaller, in its own shape
std::vector<render::Polyline> outlines_of(const FieldOfView& field, const Pose& T_world_body,
                                          double longest_m);

}  // namespace hallway::run
