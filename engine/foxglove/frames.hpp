// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace hallway::foxglove::frames {

// The coordinate frames, a tree: world → body_truth, world → map → body → sensor_N, world → odom_N.

inline constexpr const char* kWorld = "world";
inline constexpr const char* kTrueBody = "body_truth";  ///< where the body is
inline constexpr const char* kMap = "map";              ///< the plugin's
inline constexpr const char* kBody = "body";            ///< where the plugin takes the body to be

/// The frame of the sensor with this id.
inline std::string sensor(std::uint32_t id) {
  return fmt::format("sensor_{}", id);
}

/// The frame that the poses of the sensor of odometry with this id are in.
inline std::string odometry(std::uint32_t id) {
  return fmt::format("odom_{}", id);
}

}  // namespace hallway::foxglove::frames
