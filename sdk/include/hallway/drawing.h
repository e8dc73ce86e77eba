// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"

#ifdef __cplusplus
extern "C" {
#endif

/// hw_drawing_item_t.kind. Since 1.6.
enum {
  HW_DRAWING_POLYLINE = 1,  ///< two points or more, joined in their order
  HW_DRAWING_CIRCLE = 2,    ///< one point, its middle
  HW_DRAWING_TEXT = 3       ///< one point, where it stands
};

/// hw_drawing_item_t.colour: what an item is of; every host has a colour for it. Since 1.6.
enum {
  HW_COLOUR_PLAIN = 0,
  HW_COLOUR_FAINT = 1,
  HW_COLOUR_SENSED = 2,    ///< what a sensor saw
  HW_COLOUR_FOLLOWED = 3,  ///< e.g. the wall that the robot follows
  HW_COLOUR_PLANNED = 4,   ///< where it wants to go
  HW_COLOUR_LANDMARK = 5,  ///< a place that it knows
  HW_COLOUR_WARNING = 6,   ///< what is wrong or in the way
  HW_COLOUR_HIGHLIGHT = 7  ///< what matters most now
};

/// Flag of a polyline: its last point is joined to the first one. Since 1.6.
#define HW_DRAWING_CLOSED 1u

/// Limits of a drawing. Since 1.6.
#define HW_MAX_DRAWING_ITEMS 4096u
#define HW_MAX_DRAWING_POINTS 65536u
/// Bytes of hw_drawing_item_t.text without its terminating 0.
#define HW_MAX_DRAWING_TEXT_BYTES 200u

/// A point in the body's frame of the frame that is answered. Frozen; since 1.6.
typedef struct hw_drawing_point_t {
  double x_m;  ///< forward; finite
  double y_m;  ///< to the left; finite
} hw_drawing_point_t;

/// A line, a circle or a text. Frozen; since 1.6.
typedef struct hw_drawing_item_t {
  uint32_t kind;         ///< HW_DRAWING_…; a host skips what it does not know
  uint32_t colour;       ///< HW_COLOUR_…
  uint32_t flags;        ///< HW_DRAWING_CLOSED
  uint32_t reserved;     ///< 0
  double radius_m;       ///< of a circle, above 0, finite; else 0
  uint64_t first_point;  ///< its points are points[first_point … first_point + n_points - 1]
  uint64_t n_points;     ///< as the kind says
  const char* text;      ///< of a text: UTF-8, not empty; else null
} hw_drawing_item_t;

/// Payload of HW_OUTPUT_DRAWING: what the plugin shows of itself at this frame, for people. It lasts until the next frame. Since 1.6.
typedef struct hw_drawing_t {
  uint32_t size;          ///< sizeof(hw_drawing_t) of the writer
  uint32_t stride;        ///< bytes from one item to the next, a multiple of 8
  uint64_t count;         ///< number of items, at most HW_MAX_DRAWING_ITEMS
  const void* items;      ///< hw_drawing_item_t by `stride`
  uint32_t point_stride;  ///< bytes from one point to the next, a multiple of 8
  uint32_t reserved;      ///< 0
  uint64_t n_points;      ///< number of entries in `points`, at most HW_MAX_DRAWING_POINTS
  const void* points;     ///< hw_drawing_point_t by `point_stride`
} hw_drawing_t;

#ifdef __cplusplus
}
#endif
