// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What is known of a robot's body: upright, its outline a convex polygon or a circle about the body's z axis. Lengths in metres, in the body's
/// frame. A number that is not known is NaN. Since 1.4.
typedef struct hw_body_info_t {
  uint32_t size;       ///< sizeof(hw_body_info_t) of the writer
  uint32_t n_corners;  ///< of the polygon, 3 at least; 0: a circle
  const double*
      corners;      ///< x and y of each corner, counter-clockwise, each turn to the left; null for a circle
  double radius_m;  ///< of the circle; of a polygon the distance of its farthest corner from the z axis
  double bottom_m;  ///< z of its lowest point
  double top_m;     ///< z of its highest point
} hw_body_info_t;

/// x and y of corner `i` of an outline, i < n_corners. [any]
static inline const double* hw_body_corner(const hw_body_info_t* body, uint32_t i) {
  return body->corners + 2 * HW_CAST(uint64_t, i);
}

#ifdef __cplusplus
}
#endif
