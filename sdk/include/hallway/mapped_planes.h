// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Flag of hw_mapped_corner_t: the edge from this corner to the next one is where the plane truly ends. Without it the
/// plane was seen up to there, and may go on. Since 1.3.
#define HW_EDGE_CERTAIN 1u

/// A corner of a mapped plane's outline, and the edge from it to the next corner; the last one's leads to the first.
/// Frozen; since 1.3.
typedef struct hw_mapped_corner_t {
  double position[3];  ///< x, y, z in the map's frame, metres; finite, on the plane
  uint32_t flags;      ///< HW_EDGE_…
  uint32_t reserved;   ///< 0
} hw_mapped_corner_t;

/// A plane of the map, as far as it is known: a wall, a floor, a board. Planes and landmarks have one numbering, which
/// associations and members of submaps refer to. What is said to lie on the plane does so to 1e-5 of the distance of the
/// farthest corner from the map's origin. Frozen; since 1.3.
typedef struct hw_mapped_plane_t {
  uint64_t id;            ///< names the plane for the life of the plugin; not HW_NO_LANDMARK
  double normal[3];       ///< unit (to 1e-6), map frame; towards the side that it was seen from
  double offset_m;        ///< normal . x = offset_m for x on the plane; finite
  uint32_t observations;  ///< how many observations it was made from
  uint32_t status;        ///< HW_LANDMARK_…
  /// Its outline is corners[first_corner … first_corner + n_corners - 1]: counter-clockwise seen from where the normal
  /// points. Of an upright wall: left and right at the bottom, right and left at the top, so that the edges from the
  /// second and from the fourth corner are its ends.
  uint64_t first_corner;
  uint64_t n_corners;  ///< 3 or more
} hw_mapped_plane_t;

/// Payload of HW_OUTPUT_MAPPED_PLANES. The planes' ranges within `corners` follow each other in the order of the planes
/// and do not overlap. Since 1.3.
typedef struct hw_mapped_planes_t {
  uint32_t size;           ///< sizeof(hw_mapped_planes_t) of the writer
  uint32_t stride;         ///< bytes from one plane to the next, a multiple of 8
  uint64_t count;          ///< number of planes
  const void* planes;      ///< hw_mapped_plane_t by `stride`; ids distinct in a call, also from landmarks'
  uint32_t corner_stride;  ///< bytes from one corner to the next, a multiple of 8
  uint32_t reserved;       ///< 0
  uint64_t n_corners;      ///< number of entries in `corners`
  const void* corners;     ///< hw_mapped_corner_t by `corner_stride`
} hw_mapped_planes_t;

#ifdef __cplusplus
}
#endif
