// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"
#include "robot.h"
#include "sample.h"

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

/// What is known of a contact zone: a sector about the z axis of the sensor's frame, and a range of heights. A number that is not known is NaN.
/// Frozen; since 1.4.
typedef struct hw_bump_zone_info_t {
  const char* name;   ///< UTF-8, never null
  double middle_rad;  ///< direction of the sector's middle from the x axis, counter-clockwise
  double width_rad;   ///< full angle of the sector, above 0 and at most a turn
  double bottom_m;    ///< z of its lower end; NaN also where it has no end
  double top_m;       ///< z of its upper end; NaN also where it has no end
} hw_bump_zone_info_t;

/// hw_sensor_info_t.intrinsics of a sensor of HW_SAMPLE_BUMP. Since 1.4.
typedef struct hw_bump_info_t {
  uint32_t size;    ///< sizeof(hw_bump_info_t) of the writer
  uint32_t stride;  ///< bytes from one zone to the next, a multiple of 8
  uint64_t count;   ///< number of zones
  const void*
      zones;  ///< hw_bump_zone_info_t by `stride`: zone i is hw_bump_zone_t.zone i; use hw_bump_zone_info_at()
} hw_bump_info_t;

/// What is known of the zones of a sensor; null where nothing is, or it is none of HW_SAMPLE_BUMP. [any]
static inline const hw_bump_info_t* hw_bump_info_of(const hw_sensor_info_t* sensor) {
  const void* found = sensor->kind == HW_SAMPLE_BUMP ? hw_intrinsics_of(sensor) : HW_CAST(const void*, 0);
  return HW_CAST(const hw_bump_info_t*, found);
}

/// What is known of zone `i`, i < count. [any]
static inline const hw_bump_zone_info_t* hw_bump_zone_info_at(const hw_bump_info_t* bump, uint64_t i) {
  const void* at = HW_CAST(const char*, bump->zones) + i * bump->stride;
  return HW_CAST(const hw_bump_zone_info_t*, at);
}

#ifdef __cplusplus
}
#endif
