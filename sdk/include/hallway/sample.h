// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Kinds of samples, and what hw_sample_t.payload points to. Numbers without a payload type are reserved.
enum {
  HW_SAMPLE_POINTS = 1,      ///< hw_points_t
  HW_SAMPLE_PLANES = 2,      ///< hw_planes_t (planes.h); since 1.1
  HW_SAMPLE_SEGMENTS = 3,    ///< reserved
  HW_SAMPLE_RANGE_SCAN = 4,  ///< hw_range_scan_t (range_scan.h); since 1.5
  HW_SAMPLE_BUMP = 5,        ///< hw_bump_t (bump.h); since 1.4
  HW_SAMPLE_ENCODER = 6,     ///< hw_encoder_t (encoder.h); since 1.4
  HW_SAMPLE_ODOMETRY = 7,    ///< hw_odometry_t (odometry.h); since 1.5
  HW_SAMPLE_IMAGE = 8,       ///< reserved
  HW_SAMPLE_DEPTH = 9,       ///< reserved
  HW_SAMPLE_IMU = 10,        ///< hw_imu_t (imu.h); since 1.5
  HW_SAMPLE_GNSS = 11,       ///< hw_gnss_t (gnss.h); since 1.5
  HW_SAMPLE_MAGNETIC = 12    ///< hw_magnetic_t (magnetic.h); since 1.5
};

/// Flag of a sample: hw_points_t.track is given.
#define HW_SAMPLE_TRACKED 1u

/// "The sensor does not follow this point": an id of hw_points_t.track that many points may have. Since 1.2.
#define HW_NO_TRACK UINT64_MAX

/// One reading of one sensor. The payload is as large as its own `size` or `count` and `stride` say.
typedef struct hw_sample_t {
  uint32_t size;        ///< sizeof(hw_sample_t) of the writer
  uint32_t kind;        ///< HW_SAMPLE_…; skip what you do not know
  uint32_t flags;       ///< HW_SAMPLE_TRACKED
  uint32_t sensor_id;   ///< hw_sensor_info_t.id of the sensor
  uint64_t sequence;    ///< counts the readings of this sensor, from 0
  int64_t t_begin_ns;   ///< when the measurement began, nanoseconds of the host's clock
  int64_t t_end_ns;     ///< when it ended, not before t_begin_ns; the same for an instantaneous one
  const void* payload;  ///< by kind; never null
} hw_sample_t;

/// A point in metres. Frozen.
typedef struct hw_point3_t {
  double x, y, z;
} hw_point3_t;

/// Payload of HW_SAMPLE_POINTS: distinct points that the sensor saw, in the sensor's frame (x forward, y
/// left, z up), in an order that says nothing about which is which.
typedef struct hw_points_t {
  uint32_t size;       ///< sizeof(hw_points_t) of the writer
  uint32_t stride;     ///< bytes from one point to the next, a multiple of 8
  uint64_t count;      ///< number of points; 0 is a valid reading
  const void* points;  ///< hw_point3_t by `stride`; use hw_point_at()
  const uint64_t*
      track;  ///< null, or per point the id under which the sensor itself follows it from frame to frame
  /// Of a sensor whose points are pixels of an image: its columns and rows, and per point its pixel (row * width +
  /// column, each pixel at most once, in no order). 0, 0 and null where there is no such image. Since 1.2.
  uint32_t width;
  uint32_t height;
  const uint32_t* pixel;
  const int64_t*
      t_offset_ns;  ///< null, or per point when it was measured, after hw_sample_t.t_begin_ns; not after t_end_ns. Since 1.5.
  const float*
      intensity;  ///< null, or per point the strength of the return, from 0 on, in the sensor's unit; NaN: not known. Since 1.5.
  const uint32_t* ring;  ///< null, or per point the number of the ring that measured it. Since 1.5.
} hw_points_t;

/// Point `i` of a reading, i < count. [any]
static inline const hw_point3_t* hw_point_at(const hw_points_t* points, uint64_t i) {
  const void* at = HW_CAST(const char*, points->points) + i * points->stride;
  return HW_CAST(const hw_point3_t*, at);
}

/// When each point was measured, after hw_sample_t.t_begin_ns; null where it is not told or the writer is older than 1.5. [any]
static inline const int64_t* hw_point_times_of(const hw_points_t* points) {
  return HW_HAS(points, hw_points_t, t_offset_ns) ? points->t_offset_ns : HW_CAST(const int64_t*, 0);
}

/// The strength of each point's return; null where it is not told or the writer is older than 1.5. [any]
static inline const float* hw_point_intensities_of(const hw_points_t* points) {
  return HW_HAS(points, hw_points_t, intensity) ? points->intensity : HW_CAST(const float*, 0);
}

/// The ring that measured each point; null where it is not told or the writer is older than 1.5. [any]
static inline const uint32_t* hw_point_rings_of(const hw_points_t* points) {
  return HW_HAS(points, hw_points_t, ring) ? points->ring : HW_CAST(const uint32_t*, 0);
}

/// All that happened in one step. Everything it points to lives until the call that it is given to returns.
typedef struct hw_frame_t {
  uint32_t size;                      ///< sizeof(hw_frame_t) of the writer
  uint32_t n_samples;                 ///< number of samples; 0 is a valid frame
  uint64_t sequence;                  ///< counts the frames, from 0
  int64_t t_ns;                       ///< time of the frame, nanoseconds of the host's clock; never decreases
  const hw_sample_t* const* samples;  ///< n_samples pointers, in the order of the sensors
} hw_frame_t;

#ifdef __cplusplus
}
#endif
