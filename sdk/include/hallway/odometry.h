// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "pose.h"
#include "sample.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Payload of HW_SAMPLE_ODOMETRY: how the sensor has moved, as it reckons itself. Cumulative, so that a lost reading loses nothing. It has no
/// elements. Since 1.5.
typedef struct hw_odometry_t {
  uint32_t size;      ///< sizeof(hw_odometry_t) of the writer
  uint32_t reserved;  ///< 0
  /// Pose of the sensor at hw_sample_t.t_end_ns in a frame of its own, which is the sensor's frame when it was started; finite, unit quaternion
  /// (to 1e-6). Its error grows without end.
  hw_pose_t T_odom_sensor;
  double linear_m_s[3];  ///< velocity in the sensor's frame, x, y, z; NaN where it is not measured
  double angular_rad_s
      [3];  ///< angular velocity in the sensor's frame, about x, y, z; NaN where it is not measured
  /// Of the error of the motion since the sample before, in the sensor's frame at that sample: the upper triangle, row by row, of the 6 x 6 covariance of
  /// x, y, z (metres) and a rotation vector about x, y, z (radians). A variance is NaN where it is not known, infinite where the motion along or about
  /// that axis is not measured at all, else not below 0; all are NaN where nothing is known.
  double covariance[21];
} hw_odometry_t;

/// Entry (row, column) of hw_odometry_t.covariance, row and column < 6. [any]
static inline double hw_odometry_covariance(const hw_odometry_t* odometry, uint32_t row, uint32_t column) {
  const uint32_t i = row < column ? row : column;
  const uint32_t j = row < column ? column : row;
  return odometry->covariance[i * (11 - i) / 2 + j];
}

#ifdef __cplusplus
}
#endif
