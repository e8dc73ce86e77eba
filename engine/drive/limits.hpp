// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "drive/motion.hpp"
#include "drive/spec.hpp"

namespace hallway::drive {

/// Which parts of a command a drive does not obey as given.
struct Clamps {
  bool speed = false;      ///< the forward part was too great
  bool lateral = false;    ///< the lateral part was too great
  bool angular = false;    ///< the angular part was too great
  bool steering = false;   ///< ackermann: the steering angle was too great
  bool left_out = false;   ///< a part that the drive cannot do: sideways on wheels, a car's turn on the spot
  bool dead_band = false;  ///< a part was too small

  /// Whether a part was too great.
  bool any_limit() const { return speed || lateral || angular || steering; }
  bool operator==(const Clamps&) const = default;
};

/// What a drive makes of a command.
struct LimitedCommand {
  Command command{};                     ///< as obeyed
  std::optional<double> steering_rad{};  ///< ackermann: the angle that is steered for; empty: the present one
  Clamps clamps{};
};

/// Whether no wheel is faster than max_speed_m_s under this twist, but for rounding. Always true for ackermann, whose limit is that of the rear axle's
/// middle.
bool wheels_are_within(const DriveSpec& spec, const PlanarTwist& twist);

/// Limits a finite command of any size, without overflow.
///
/// Each part is set to zero in its dead band, or left out, or clamped to its own limit. Then, if a wheel would be too fast, all parts are scaled by one
/// number, which keeps the curvature and the direction. Ackermann: the angle is atan(angular * axle_distance / forward), clamped; a command that goes
/// nowhere does not turn and keeps the angle.
LimitedCommand limit(const DriveSpec& spec, const Command& command);

}  // namespace hallway::drive
