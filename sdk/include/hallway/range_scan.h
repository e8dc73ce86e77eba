// SPDX-License-Identifier: MIT
#pragma once

#include <math.h>
#include <stdint.h>

#include "growth.h"
#include "robot.h"
#include "sample.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A ray of a range sensor and what it measured. Frozen; since 1.5.
typedef struct hw_ray_t {
  double azimuth_rad;    ///< in the sensor's frame, from the x axis towards the y axis; from -2 pi to 2 pi
  double elevation_rad;  ///< above the x-y plane; from -pi/2 to pi/2
  double
      range_m;  ///< from 0 on. Infinite: nothing is within the sensor's range. NaN: no answer, nothing is known
} hw_ray_t;

/// Payload of HW_SAMPLE_RANGE_SCAN: rays from the origin of the sensor's frame. Optional arrays are packed and have an entry for each of the
/// `count` rays. Since 1.5.
typedef struct hw_range_scan_t {
  uint32_t size;     ///< sizeof(hw_range_scan_t) of the writer
  uint32_t stride;   ///< bytes from one ray to the next, a multiple of 8
  uint64_t count;    ///< number of rays, in all layers; 0 is a valid reading
  const void* rays;  ///< hw_ray_t by `stride`; use hw_ray_at()
  /// Of an organised scan its columns (firing times) and rows (rings): ray (row, column) of layer L is
  /// L * width * height + row * width + column, and count = layers * width * height. 0, 0: not organised, count is a
  /// multiple of layers.
  uint32_t width;
  uint32_t height;
  /// Returns of each ray, from 1 on; the layers follow each other. Layer 0 is the first, or the only, return; a ray without a further one has a
  /// range of NaN in that layer.
  uint32_t layers;
  uint32_t reserved;  ///< 0
  const int64_t*
      t_offset_ns;  ///< null, or when the ray was measured, after hw_sample_t.t_begin_ns; not after t_end_ns
  const float*
      intensity;  ///< null, or the strength of the return, from 0 on, in the sensor's unit; NaN where there is none
  const uint32_t* ring;  ///< null, or the number of the ring that measured it
} hw_range_scan_t;

/// Ray `i` of a scan, i < count. [any]
static inline const hw_ray_t* hw_ray_at(const hw_range_scan_t* scan, uint64_t i) {
  const void* at = HW_CAST(const char*, scan->rays) + i * scan->stride;
  return HW_CAST(const hw_ray_t*, at);
}

/// Where a ray points: a unit vector in the sensor's frame. [any]
static inline hw_point3_t hw_ray_direction(const hw_ray_t* ray) {
  const double level = cos(ray->elevation_rad);
  hw_point3_t direction;
  direction.x = level * cos(ray->azimuth_rad);
  direction.y = level * sin(ray->azimuth_rad);
  direction.z = sin(ray->elevation_rad);
  return direction;
}

/// Whether a ray met something: 1 where its range is a number, 0 where it is infinite or NaN. [any]
static inline int hw_ray_has_return(const hw_ray_t* ray) {
  return ray->range_m - ray->range_m == 0.0;
}

/// The point in the sensor's frame, metres, that a ray met; of a ray with hw_ray_has_return(). [any]
static inline hw_point3_t hw_ray_point(const hw_ray_t* ray) {
  hw_point3_t point = hw_ray_direction(ray);
  point.x *= ray->range_m;
  point.y *= ray->range_m;
  point.z *= ray->range_m;
  return point;
}

/// When ray `i` was measured, i < count; hw_sample_t.t_begin_ns where the scan does not tell it. [any]
static inline int64_t hw_ray_time_ns(const hw_sample_t* sample, const hw_range_scan_t* scan, uint64_t i) {
  return sample->t_begin_ns + (scan->t_offset_ns ? scan->t_offset_ns[i] : 0);
}

/// hw_sensor_info_t.intrinsics of a sensor of HW_SAMPLE_RANGE_SCAN. Since 1.5.
typedef struct hw_range_scan_info_t {
  uint32_t size;    ///< sizeof(hw_range_scan_info_t) of the writer
  uint32_t width;   ///< columns of its scans; 0: not organised, or not known
  uint32_t height;  ///< rows; 0 likewise
  uint32_t layers;  ///< most returns of a ray; 0: not known
  double beam_rad;  ///< full divergence of a beam; NaN: not known
  double scan_s;    ///< time of a scan; NaN: not known
} hw_range_scan_info_t;

/// What else is known of a sensor; null where nothing is, or it is none of HW_SAMPLE_RANGE_SCAN. [any]
static inline const hw_range_scan_info_t* hw_range_scan_info_of(const hw_sensor_info_t* sensor) {
  const void* found =
      sensor->kind == HW_SAMPLE_RANGE_SCAN ? hw_intrinsics_of(sensor) : HW_CAST(const void*, 0);
  return HW_CAST(const hw_range_scan_info_t*, found);
}

#ifdef __cplusplus
}
#endif
