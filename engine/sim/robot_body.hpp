// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "contact/shape.hpp"
#include "map/robot_shape.hpp"
#include "sense/own_body.hpp"
#include "sim/scenario.hpp"

namespace hallway::sim {

/// A box about the z axis.
struct BoxSize {
  double length_m = 0.0;  ///< along x
  double width_m = 0.0;
};

/// The size of a body of a robot file that is a box with sides along the axes and its middle on the z axis.
std::optional<BoxSize> box_of(const map::RobotBody& body);

/// Whether the robot is more than a point.
bool has_body(const RobotSpec& robot);

// Of robots with a body, in its frame.

/// Its lowest and its highest z.
std::pair<double, double> height_of(const RobotSpec& robot);
/// Moved along z so that its lowest point is at `low`.
contact::BodyShape shape_of(const RobotSpec& robot, double low);
/// The radius of gyration about the z axis, of a prism of even density with its outline; at least 1 mm.
double gyration_of(const RobotSpec& robot);
/// Seen from above, counter-clockwise; empty for a cylinder.
std::vector<Vec2> outline_of(const RobotSpec& robot);

/// The body as the robot's own sensors see it; none of a robot that is a point.
std::optional<sense::OwnBody> own_body_of(const RobotSpec& robot);

}  // namespace hallway::sim
