// SPDX-License-Identifier: MIT
#pragma once

#include <math.h>
#include <stdint.h>

#include "body.h"
#include "drive.h"
#include "growth.h"
#include "pose.h"

#ifdef __cplusplus
extern "C" {
#endif

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
  /// By kind what else is known, a struct whose first member is `size`: hw_encoder_info_t (encoder.h), hw_bump_info_t (bump.h), hw_range_scan_info_t
  /// (range_scan.h), hw_imu_info_t (imu.h), hw_gnss_info_t (gnss.h); null for other kinds and where nothing is known. Since 1.4.
  const void* intrinsics;
  double rate_hz;         ///< readings a second; 0: one for each frame. Since 1.5.
  double latency_s;       ///< from the end of a measurement to its frame. Since 1.5.
  double noise_per_m[3];  ///< what noise_m grows by for each metre of distance. Since 1.5.
} hw_sensor_info_t;

/// The facts that are given once, at activation. They live until activate() returns.
typedef struct hw_activation_t {
  uint32_t size;                           ///< sizeof(hw_activation_t) of the writer
  uint32_t n_sensors;                      ///< number of sensors
  const hw_sensor_info_t* const* sensors;  ///< n_sensors pointers; ids are distinct
  const hw_drive_info_t* drive;            ///< null where it is not known; use hw_drive_of(). Since 1.4.
  const hw_body_info_t* body;              ///< null where it is not known; use hw_body_of(). Since 1.4.
} hw_activation_t;

/// The robot's drive; null where it is not known or the host is older than 1.4. [any]
static inline const hw_drive_info_t* hw_drive_of(const hw_activation_t* activation) {
  return HW_HAS(activation, hw_activation_t, drive) ? activation->drive : HW_CAST(const hw_drive_info_t*, 0);
}

/// The robot's body; null where it is not known or the host is older than 1.4. [any]
static inline const hw_body_info_t* hw_body_of(const hw_activation_t* activation) {
  return HW_HAS(activation, hw_activation_t, body) ? activation->body : HW_CAST(const hw_body_info_t*, 0);
}

/// What else is known of a sensor, by its kind; null where nothing is or the writer is older than 1.4. [any]
static inline const void* hw_intrinsics_of(const hw_sensor_info_t* sensor) {
  return HW_HAS(sensor, hw_sensor_info_t, intrinsics) ? sensor->intrinsics : HW_CAST(const void*, 0);
}

/// Readings of a sensor in a second, 0: one for each frame; NaN where it is not known or the writer is older than 1.5. [any]
static inline double hw_rate_hz_of(const hw_sensor_info_t* sensor) {
  return HW_HAS(sensor, hw_sensor_info_t, rate_hz) ? sensor->rate_hz : HW_CAST(double, NAN);
}

/// From the end of a sensor's measurement to its frame, seconds; NaN where it is not known or the writer is older than 1.5. [any]
static inline double hw_latency_s_of(const hw_sensor_info_t* sensor) {
  return HW_HAS(sensor, hw_sensor_info_t, latency_s) ? sensor->latency_s : HW_CAST(double, NAN);
}

/// What a sensor's noise along an axis, below 3, grows by for each metre of distance; NaN where it is not known or the writer is older than 1.5. [any]
static inline double hw_noise_per_m_of(const hw_sensor_info_t* sensor, uint32_t axis) {
  return HW_HAS(sensor, hw_sensor_info_t, noise_per_m) ? sensor->noise_per_m[axis] : HW_CAST(double, NAN);
}

#ifdef __cplusplus
}
#endif
