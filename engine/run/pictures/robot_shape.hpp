// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::run {

/// The outline of a robot's body, upright and convex, in the body's frame [m].
struct RobotShape {
  std::vector<Vec2> corners{};
  bool is_round = false;  ///< the corners are of a circle
  double bottom_m = 0.0;
  double top_m = 0.0;
};

/// The body that a run.json names (`robot.body`); empty where it names none. Throws Error{kBadInput} for one that is none.
std::optional<RobotShape> robot_shape(const nlohmann::ordered_json& manifest);

}  // namespace hallway::run
