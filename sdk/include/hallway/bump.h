// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A contact zone of the robot's body, pressed or not. Frozen; since 1.4.
typedef struct hw_bump_zone_t {
  /// In the sensor's frame, from the robot towards what it touches, unit (to 1e-6). Zeros where the zone is not pressed or the
  /// direction is not known.
  double direction[3];
  double
      depth_m;  ///< how far the zone is pressed in, from 0 on; NaN where it is not pressed or the depth is not known
  uint32_t zone;     ///< number of the zone, for the life of the sensor
  uint32_t pressed;  ///< 1 where it touches something, else 0
} hw_bump_zone_t;

/// Payload of HW_SAMPLE_BUMP: all zones of the sensor, also those that are not pressed. Since 1.4.
typedef struct hw_bump_t {
  uint32_t size;      ///< sizeof(hw_bump_t) of the writer
  uint32_t stride;    ///< bytes from one zone to the next, a multiple of 8
  uint64_t count;     ///< number of zones; 0 is a valid reading
  const void* zones;  ///< hw_bump_zone_t by `stride`, their numbers ascending; use hw_bump_zone_at()
} hw_bump_t;

/// Zone `i` of a reading, i < count. [any]
static inline const hw_bump_zone_t* hw_bump_zone_at(const hw_bump_t* bump, uint64_t i) {
  const void* at = HW_CAST(const char*, bump->zones) + i * bump->stride;
  return HW_CAST(const hw_bump_zone_t*, at);
}

#ifdef __cplusplus
}
#endif
