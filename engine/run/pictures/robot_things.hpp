// SPDX-License-Identifier: MIT
#pragma once

#include "map/robot_file.hpp"
#include "render/picture.hpp"
#include "run/pictures/map_things.hpp"

namespace hallway::run {

/// A picture of a robot file, in the body's frame: the body, its bump zones by colour and name, the wheels of its drive, and the mounts of its sensors with
/// their fields of view, no longer than the body. An arrow goes ahead from the origin.
/// @param things  `sensors`: whether those are shown
render::Picture compose_robot_picture(const map::RobotFile& robot, const MapThings& things);

}  // namespace hallway::run
