// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"
#include "robot.h"
#include "sample.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What the encoder of a wheel has counted. Frozen; since 1.4.
typedef struct hw_wheel_ticks_t {
  int64_t
      ticks;  ///< since the sensor was started, forward positive; cumulative, so that a lost reading loses nothing
} hw_wheel_ticks_t;

/// Payload of HW_SAMPLE_ENCODER: the counts of all wheels of the sensor. Since 1.4.
typedef struct hw_encoder_t {
  uint32_t size;       ///< sizeof(hw_encoder_t) of the writer
  uint32_t stride;     ///< bytes from one wheel to the next, a multiple of 8
  uint64_t count;      ///< number of wheels; 0 is a valid reading
  const void* wheels;  ///< hw_wheel_ticks_t by `stride`, in the sensor's order; use hw_wheel_ticks_at()
} hw_encoder_t;

/// Count of wheel `i` of a reading, i < count. [any]
static inline int64_t hw_wheel_ticks_at(const hw_encoder_t* encoder, uint64_t i) {
  const void* at = HW_CAST(const char*, encoder->wheels) + i * encoder->stride;
  return HW_CAST(const hw_wheel_ticks_t*, at)->ticks;
}

/// What is known of a wheel with an encoder. A number that is not known is NaN. Frozen; since 1.4.
typedef struct hw_encoder_wheel_t {
  double m_per_tick;   ///< way of the wheel's rim from one tick to the next, above 0
  double position[3];  ///< where the wheel touches the floor, in the sensor's frame, metres
  double direction
      [3];  ///< where it rolls while ticks are counted forward, in the sensor's frame, unit (to 1e-6)
} hw_encoder_wheel_t;

/// hw_sensor_info_t.intrinsics of a sensor of HW_SAMPLE_ENCODER. Since 1.4.
typedef struct hw_encoder_info_t {
  uint32_t size;    ///< sizeof(hw_encoder_info_t) of the writer
  uint32_t stride;  ///< bytes from one wheel to the next, a multiple of 8
  uint64_t count;   ///< number of wheels
  const void*
      wheels;  ///< hw_encoder_wheel_t by `stride`, in the order of the readings; use hw_encoder_wheel_at()
} hw_encoder_info_t;

/// What is known of the wheels of a sensor; null where nothing is, or it is none of HW_SAMPLE_ENCODER. [any]
static inline const hw_encoder_info_t* hw_encoder_info_of(const hw_sensor_info_t* sensor) {
  const void* found = sensor->kind == HW_SAMPLE_ENCODER ? hw_intrinsics_of(sensor) : HW_CAST(const void*, 0);
  return HW_CAST(const hw_encoder_info_t*, found);
}

/// What is known of wheel `i`, i < count. [any]
static inline const hw_encoder_wheel_t* hw_encoder_wheel_at(const hw_encoder_info_t* encoder, uint64_t i) {
  const void* at = HW_CAST(const char*, encoder->wheels) + i * encoder->stride;
  return HW_CAST(const hw_encoder_wheel_t*, at);
}

#ifdef __cplusplus
}
#endif
