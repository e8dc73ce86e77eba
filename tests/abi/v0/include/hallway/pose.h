// SPDX-License-Identifier: MIT
#pragma once

/// A rigid motion T_a_b, which maps coordinates in frame b into frame a. Right-handed frames; the body's x
/// axis points forward, y to the left, z up. Frozen.
typedef struct hw_pose_t {
  double position[3];     ///< x, y, z of b's origin in a; metres
  double orientation[4];  ///< unit quaternion w, x, y, z of the rotation
} hw_pose_t;
