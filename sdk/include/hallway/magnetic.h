// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "sample.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Payload of HW_SAMPLE_MAGNETIC: a compass. It has no elements. Since 1.5.
typedef struct hw_magnetic_t {
  uint32_t size;      ///< sizeof(hw_magnetic_t) of the writer
  uint32_t reserved;  ///< 0
  double
      heading_rad;  ///< of the sensor's x axis from magnetic north, to the left, from -pi to pi; NaN where it is not known
  double
      variance_rad2;  ///< of its error where nothing disturbs the field, not below 0; NaN where it is not known
} hw_magnetic_t;

#ifdef __cplusplus
}
#endif
