// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "host/robot_parts.hpp"
#include "host/sensor_info.hpp"

namespace hallway::host {

/// The facts that plugins are given once; see hw_activation_t. A list of sensors is one of which nothing else is known.
struct Activation {
  Activation() = default;
  Activation(std::vector<SensorInfo> of_sensors, std::optional<DriveInfo> of_drive = {},
             std::optional<BodyInfo> of_body = {})
      : sensors(std::move(of_sensors)), drive(std::move(of_drive)), body(std::move(of_body)) {}
  Activation(std::initializer_list<SensorInfo> of_sensors) : sensors(of_sensors) {}

  std::vector<SensorInfo> sensors{};  ///< of distinct ids
  std::optional<DriveInfo> drive{};   ///< unset: not known
  std::optional<BodyInfo> body{};     ///< unset: not known
};

}  // namespace hallway::host
