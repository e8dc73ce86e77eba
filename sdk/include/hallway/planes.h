// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"
#include "sample.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Stands for "no sample of this frame"; never the index of one. Since 1.1.
#define HW_NO_SAMPLE UINT32_MAX

/// A finite plane that was found in points, in the frame of the sensor that saw them. All numbers are finite. What is
/// said to lie on the plane does so to 1e-5 of the distance of the farthest corner. A point may be a member of several
/// planes, e.g. at a seam. Frozen; since 1.1.
typedef struct hw_plane_t {
  uint64_t id;         ///< distinct in its list; kept where the plane is known to be one of the frame before
  double normal[3];    ///< unit (to 1e-6); of the two directions the one towards the sensor: offset_m <= 0
  double offset_m;     ///< normal . x = offset_m for x on the plane
  double centroid[3];  ///< of its points, on the plane
  /// Of a rectangle on the plane around its points, counter-clockwise seen from where the normal points; may be without
  /// width.
  double corners[4][3];
  uint64_t n_points;  ///< how many points it was made from
  double rms_m;       ///< their root mean square distance from the plane
  /// 0 to 1: of the points in its reach, the share that no other plane explains as well.
  double exclusive_share;
  uint64_t first_hull;    ///< its hull is hull_points[first_hull … first_hull + n_hull - 1]: convex, on the
                          ///< plane, counter-clockwise like the corners
  uint64_t n_hull;        ///< 0: the hull is not told
  uint64_t first_member;  ///< its points are members[first_member … first_member + n_members - 1], ascending
  uint64_t n_members;     ///< n_points; or 0: they are not told
} hw_plane_t;

/// Payload of HW_OUTPUT_PLANES: the planes that a plugin found in one sample; and of HW_SAMPLE_PLANES: planes that a
/// sensor gives, or that another plugin found in a sample of the same frame. The planes' ranges within hull_points, and
/// those within members, follow each other in the order of the planes and do not overlap. Since 1.1.
typedef struct hw_planes_t {
  uint32_t size;       ///< sizeof(hw_planes_t) of the writer
  uint32_t stride;     ///< bytes from one plane to the next, a multiple of 8
  uint64_t count;      ///< number of planes; 0 is a valid answer
  const void* planes;  ///< hw_plane_t by `stride`; use hw_plane_at()
  /// Index in hw_frame_t.samples of the sample that they were found in. HW_NO_SAMPLE only in a sample of planes: there
  /// is none, and there are no members.
  uint32_t sample;
  uint32_t hull_stride;     ///< bytes from one hull point to the next, a multiple of 8
  uint64_t n_hull_points;   ///< number of entries in `hull_points`
  const void* hull_points;  ///< hw_point3_t by `hull_stride`
  uint64_t n_members;       ///< number of entries in `members`
  const uint32_t* members;  ///< indices of elements of that sample
} hw_planes_t;

/// Plane `i` of a list, i < count. [any]
static inline const hw_plane_t* hw_plane_at(const hw_planes_t* planes, uint64_t i) {
  const void* at = HW_CAST(const char*, planes->planes) + i * planes->stride;
  return HW_CAST(const hw_plane_t*, at);
}

#ifdef __cplusplus
}
#endif
