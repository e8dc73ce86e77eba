// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"

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

#ifdef __cplusplus
}
#endif
