// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include "geometry/se3.hpp"

namespace hallway::contact {

/// The velocity of a body in its own floor plane, in the body's frame: x forward, y left, the turn about its z axis.
struct PlanarTwist {
  double x_m_s = 0.0;
  double y_m_s = 0.0;
  double turn_rad_s = 0.0;

  /// Speed of the body's origin.
  double speed() const { return std::hypot(x_m_s, y_m_s); }
  bool is_zero() const { return x_m_s == 0.0 && y_m_s == 0.0 && turn_rad_s == 0.0; }
  PlanarTwist operator+(const PlanarTwist& other) const {
    return {x_m_s + other.x_m_s, y_m_s + other.y_m_s, turn_rad_s + other.turn_rad_s};
  }
  PlanarTwist operator-(const PlanarTwist& other) const {
    return {x_m_s - other.x_m_s, y_m_s - other.y_m_s, turn_rad_s - other.turn_rad_s};
  }
  PlanarTwist operator*(double factor) const { return {x_m_s * factor, y_m_s * factor, turn_rad_s * factor}; }
  bool operator==(const PlanarTwist&) const = default;
};

/// A twist that changes linearly in time.
struct TwistRamp {
  PlanarTwist from{};
  PlanarTwist to{};
  std::int64_t duration_ns = 0;  ///< at least 1

  /// The twist at a share of the duration, in [0, 1].
  PlanarTwist at(double share) const { return from + (to - from) * share; }
};

/// Greatest parts of a twist that are accepted: metres per second and radians per second.
inline constexpr double kGreatestSpeed = 100.0;
inline constexpr double kGreatestTurn = 100.0;
/// Longest ramp that is accepted: an hour.
inline constexpr std::int64_t kGreatestDuration_ns = 3'600'000'000'000;

/// Throws Error{kBadInput} for a twist with a part that is no number or beyond the greatest.
void check_twist(const PlanarTwist& twist);
/// The same for both ends of a ramp, and for a duration that is not in [1, kGreatestDuration_ns].
void check_ramp(const TwistRamp& ramp);

/// The motion of a body in its own plane from the beginning of a ramp to a share of its duration: T_begin_share.
///
/// The heading is exact; the position is a quadrature of Gauss and Legendre of five points, with an error below 1e-15 of its
/// length for turns of up to 0.1 rad.
/// @param share  of the duration, in [0, 1]
Pose planar_motion(const TwistRamp& ramp, double share);

}  // namespace hallway::contact
