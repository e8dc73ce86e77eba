// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/hallway.h>

#include <cstdint>
#include <optional>

namespace hallway::conformance {

/// What an activation says of a robot beside its sensors.
struct RobotFacts {
  std::optional<hw_drive_info_t> drive{};
  std::optional<hw_body_info_t> body{};  ///< its corners live as long as the program
};

/// A robot of two wheels with a body of four corners, all facts known.
RobotFacts ordinary_robot();

/// hw_sensor_info_t.intrinsics of a sensor of a kind, all facts known; null where there are none. They live as long as the program.
const void* ordinary_intrinsics(std::uint32_t kind);

}  // namespace hallway::conformance
