// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/robot.h>

#include "host/stage.hpp"

namespace hallway::host {

/// A sensor's facts as the ABI has them; the name stays that of `sensor`.
hw_sensor_info_t c_sensor(const SensorInfo& sensor);

}  // namespace hallway::host
