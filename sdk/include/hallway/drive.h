// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "growth.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How a robot moves. Since 1.4.
enum {
  HW_DRIVE_UNKNOWN = 0,         ///< not known, or of a kind that has no number yet
  HW_DRIVE_DIFFERENTIAL = 1,    ///< two driven wheels: goes ahead and turns on the spot
  HW_DRIVE_TRACKED = 2,         ///< two tracks, which slip in turns: likewise
  HW_DRIVE_ACKERMANN = 3,       ///< steered as a car: turns only while it goes
  HW_DRIVE_OMNIDIRECTIONAL = 4  ///< goes in all directions, and turns on the spot
};

/// What is known of a robot's drive. A limit holds in both directions, and a command beyond it is clamped; so is one
/// whose parts together ask too much of a wheel or of the steering. A number that is not known, or has no
/// meaning for the kind, is NaN; others are finite and not below 0. Since 1.4.
typedef struct hw_drive_info_t {
  uint32_t size;                           ///< sizeof(hw_drive_info_t) of the writer
  uint32_t kind;                           ///< HW_DRIVE_…; take what you do not know for HW_DRIVE_UNKNOWN
  double max_speed_m_s;                    ///< greatest hw_drive_command_t.linear_m_s
  double max_lateral_m_s;                  ///< greatest lateral_m_s; 0: it does not go sideways
  double max_angular_rad_s;                ///< greatest angular_rad_s
  double max_acceleration_m_s2;            ///< while a speed grows
  double max_deceleration_m_s2;            ///< while a speed shrinks
  double max_angular_acceleration_rad_s2;  ///< of the turn
  double greatest_steering_rad;            ///< of HW_DRIVE_ACKERMANN: angle of the front wheels
  double max_steering_rate_rad_s;          ///< of this angle
  double wheel_base_m;                     ///< between left and right wheels, or the middles of the tracks
  double axle_distance_m;                  ///< between front and rear axle
  double wheel_radius_m;
  double latency_s;        ///< from a command to its first effect
  double dead_band_m_s;    ///< a smaller linear_m_s or lateral_m_s does nothing
  double dead_band_rad_s;  ///< a smaller angular_rad_s does nothing
} hw_drive_info_t;

/// Whether a drive turns while it stands: 1 yes, 0 no or not known. `drive` may be null. [any]
static inline int hw_turns_on_the_spot(const hw_drive_info_t* drive) {
  return drive && (drive->kind == HW_DRIVE_DIFFERENTIAL || drive->kind == HW_DRIVE_TRACKED ||
                   drive->kind == HW_DRIVE_OMNIDIRECTIONAL);
}

/// A part of a command within a limit of the drive: `value`, but not farther from 0 than `limit` where that is known. [any]
static inline double hw_within_limit(double value, double limit) {
  if (value > limit) return limit;
  if (value < -limit) return -limit;
  return value;
}

#ifdef __cplusplus
}
#endif
