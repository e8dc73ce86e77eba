// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/robot.h>

#include <algorithm>

#include "host/sensor_info.hpp"

namespace hallway::host {

/// Copies what every form of a sensor's facts has, but for its name, its intrinsics and what came with version 1.5: SensorInfo, that of the ABI, that of a datagram.
template <typename From, typename To>
void copy_sensor_facts(const From& from, To& to) {
  to.id = from.id;
  to.kind = from.kind;
  to.T_body_sensor = from.T_body_sensor;
  to.horizontal_fov = from.horizontal_fov;
  to.vertical_fov = from.vertical_fov;
  to.min_range_m = from.min_range_m;
  to.max_range_m = from.max_range_m;
  std::ranges::copy(from.noise_m, to.noise_m);
}

}  // namespace hallway::host
