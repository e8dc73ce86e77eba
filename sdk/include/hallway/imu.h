// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"
#include "robot.h"
#include "sample.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Payload of HW_SAMPLE_IMU: means from hw_sample_t.t_begin_ns to t_end_ns, along and about the axes of the sensor's frame. An axis that the sensor does
/// not have is NaN. It has no elements. A host that drops a frame gives its samples with the next one. Since 1.5.
typedef struct hw_imu_t {
  uint32_t size;            ///< sizeof(hw_imu_t) of the writer
  uint32_t reserved;        ///< 0
  double angular_rad_s[3];  ///< angular velocity about x, y, z
  double force_m_s2
      [3];  ///< specific force along x, y, z: acceleration less gravity, so that it points up while the sensor rests
  /// Covariances of this sample's white noise: xx, xy, xz, yy, yz, zz. NaN where they are not known; variances are not below 0.
  double angular_covariance[6];
  double force_covariance[6];
} hw_imu_t;

/// hw_sensor_info_t.intrinsics of a sensor of HW_SAMPLE_IMU. A number that is not known is NaN; others are finite and not below 0. Since 1.5.
typedef struct hw_imu_info_t {
  uint32_t size;             ///< sizeof(hw_imu_info_t) of the writer
  uint32_t reserved;         ///< 0
  double gravity_m_s2;       ///< where the sensor is used
  double angular_noise;      ///< density of the white noise of angular_rad_s, rad/s/sqrt(Hz)
  double angular_walk;       ///< of the random walk of its bias, rad/s^2/sqrt(Hz)
  double force_noise;        ///< density of the white noise of force_m_s2, m/s^2/sqrt(Hz)
  double force_walk;         ///< of the random walk of its bias, m/s^3/sqrt(Hz)
  double max_angular_rad_s;  ///< beyond it the sensor saturates
  double max_force_m_s2;     ///< likewise
} hw_imu_info_t;

/// What else is known of a sensor; null where nothing is, or it is none of HW_SAMPLE_IMU. [any]
static inline const hw_imu_info_t* hw_imu_info_of(const hw_sensor_info_t* sensor) {
  const void* found = sensor->kind == HW_SAMPLE_IMU ? hw_intrinsics_of(sensor) : HW_CAST(const void*, 0);
  return HW_CAST(const hw_imu_info_t*, found);
}

#ifdef __cplusplus
}
#endif
