// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/pose.h>

#include <cstdint>
#include <string>

#include "host/intrinsics.hpp"

namespace hallway::host {

/// What is known of one sensor; see hw_sensor_info_t. A number that is not known is NaN.
struct SensorInfo {
  std::uint32_t id = 0;    ///< the number that its samples carry
  std::uint32_t kind = 0;  ///< HW_SAMPLE_… that it gives; 0: none
  std::string name;        ///< for people
  hw_pose_t T_body_sensor{{0, 0, 0}, {1, 0, 0, 0}};
  double horizontal_fov = kUnknown;  ///< full angle, radians
  double vertical_fov = kUnknown;    ///< full angle, radians
  double min_range_m = kUnknown;
  double max_range_m = kUnknown;
  double noise_m[3] = {kUnknown, kUnknown,
                       kUnknown};  ///< standard deviation along x, y, z of the sensor's frame
  Intrinsics intrinsics{};         ///< fits the kind
  double rate_hz = kUnknown;       ///< readings a second; 0: one for each frame
  double latency_s = kUnknown;     ///< from the end of a measurement to its frame
  double noise_per_m[3] = {kUnknown, kUnknown,
                           kUnknown};  ///< what noise_m grows by for each metre of distance

  static constexpr double kUnknown = __builtin_nan("");
};

}  // namespace hallway::host
