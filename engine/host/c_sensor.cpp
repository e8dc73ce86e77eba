// SPDX-License-Identifier: MIT
#include "host/c_sensor.hpp"

#include <algorithm>

namespace hallway::host {

hw_sensor_info_t c_sensor(const SensorInfo& sensor) {
  hw_sensor_info_t info{};
  info.size = sizeof info;
  info.id = sensor.id;
  info.kind = sensor.kind;
  info.name = sensor.name.c_str();
  info.T_body_sensor = sensor.T_body_sensor;
  info.horizontal_fov = sensor.horizontal_fov;
  info.vertical_fov = sensor.vertical_fov;
  info.min_range_m = sensor.min_range_m;
  info.max_range_m = sensor.max_range_m;
  std::copy(std::begin(sensor.noise_m), std::end(sensor.noise_m), info.noise_m);
  return info;
}

}  // namespace hallway::host
