// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"
#include "pose.h"

/// What is known of one sensor. A number that is not known is NaN.
typedef struct hw_sensor_info_t {
  uint32_t size;            ///< sizeof(hw_sensor_info_t) of the writer
  uint32_t id;              ///< the number that its samples carry
  uint32_t kind;            ///< HW_SAMPLE_… that it gives
  uint32_t reserved;        ///< 0
  const char* name;         ///< UTF-8, never null
  hw_pose_t T_body_sensor;  ///< where it is mounted; identity where the sensor's frame is the body's
  double horizontal_fov;    ///< full angle, radians
  double vertical_fov;      ///< full angle, radians
  double min_range_m;       ///< nearest distance that is measured
  double max_range_m;       ///< farthest distance that is measured
  double noise_m[3];        ///< standard deviation along x, y, z of the sensor's frame
} hw_sensor_info_t;

/// The facts that are given once, at activation. They live until activate() returns.
typedef struct hw_activation_t {
  uint32_t size;                           ///< sizeof(hw_activation_t) of the writer
  uint32_t n_sensors;                      ///< number of sensors
  const hw_sensor_info_t* const* sensors;  ///< n_sensors pointers; ids are distinct
} hw_activation_t;
