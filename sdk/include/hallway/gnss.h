// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"
#include "robot.h"
#include "sample.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What a receiver knows. Others may be added: treat what you do not know as HW_GNSS_POSITION.
enum {
  HW_GNSS_NO_FIX = 0,   ///< nothing
  HW_GNSS_POSITION = 1  ///< where its antenna is
};

/// Payload of HW_SAMPLE_GNSS: where a receiver's antenna is, in a level frame of its own that does not move: x east, y north, z up, its origin at
/// hw_gnss_info_t. It has no elements. Since 1.5.
typedef struct hw_gnss_t {
  uint32_t size;         ///< sizeof(hw_gnss_t) of the writer
  uint32_t fix;          ///< HW_GNSS_…
  double position_m[3];  ///< NaN without a fix
  /// Of its error: xx, xy, xz, yy, yz, zz. NaN where it is not known; variances are not below 0. Errors of fixes that follow each other are not independent.
  double covariance[6];
} hw_gnss_t;

/// hw_sensor_info_t.intrinsics of a sensor of HW_SAMPLE_GNSS: where on Earth (WGS 84) the origin of its frame is. NaN where it is not known. Since 1.5.
typedef struct hw_gnss_info_t {
  uint32_t size;         ///< sizeof(hw_gnss_info_t) of the writer
  uint32_t reserved;     ///< 0
  double latitude_deg;   ///< from -90 to 90
  double longitude_deg;  ///< from -180 to 180
  double altitude_m;     ///< above the ellipsoid
} hw_gnss_info_t;

/// What else is known of a sensor; null where nothing is, or it is none of HW_SAMPLE_GNSS. [any]
static inline const hw_gnss_info_t* hw_gnss_info_of(const hw_sensor_info_t* sensor) {
  const void* found = sensor->kind == HW_SAMPLE_GNSS ? hw_intrinsics_of(sensor) : HW_CAST(const void*, 0);
  return HW_CAST(const hw_gnss_info_t*, found);
}

#ifdef __cplusplus
}
#endif
