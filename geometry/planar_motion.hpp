// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include "geometry/se3.hpp"

namespace hallway {

/// The velocity of a body in its own plane, in the body's frame: x forward, y left, counter-clockwise turns positive.
struct PlanarTwist {
  double forward_m_s = 0.0;
  double lateral_m_s = 0.0;
  double angular_rad_s = 0.0;

  /// Speed of the body's origin [m/s].
  double speed() const { return std::hypot(forward_m_s, lateral_m_s); }
  bool is_zero() const { return forward_m_s == 0.0 && lateral_m_s == 0.0 && angular_rad_s == 0.0; }

  PlanarTwist operator+(const PlanarTwist& other) const {
    return {forward_m_s + other.forward_m_s, lateral_m_s + other.lateral_m_s,
            angular_rad_s + other.angular_rad_s};
  }
  PlanarTwist operator-(const PlanarTwist& other) const {
    return {forward_m_s - other.forward_m_s, lateral_m_s - other.lateral_m_s,
            angular_rad_s - other.angular_rad_s};
  }
  PlanarTwist operator*(double factor) const {
    return {forward_m_s * factor, lateral_m_s * factor, angular_rad_s * factor};
  }
  bool operator==(const PlanarTwist&) const = default;
};

/// A twist that is linear in time.
struct TwistRamp {
  PlanarTwist from{};
  PlanarTwist to{};
  std::int64_t duration_ns = 0;  ///< at least 0

  /// The twist at a share of the duration, in [0, 1].
  PlanarTwist at(double share) const { return share == 1.0 ? to : from + (to - from) * share; }
  bool operator==(const TwistRamp&) const = default;
};

/// A pose in the plane: metres and radians. The yaw is not wrapped.
struct PlanarPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;

  /// The same in space: level, at height 0.
  Pose level() const {
    return {Quat(std::cos(0.5 * yaw_rad), 0.0, 0.0, std::sin(0.5 * yaw_rad)), Vec3(x_m, y_m, 0.0)};
  }
};

/// The twist `t_ns` after the begin of a ramp, 0 <= t_ns <= duration; exactly `to` at its end.
PlanarTwist twist_at(const TwistRamp& ramp, std::int64_t t_ns);

/// The part of a ramp from `begin_ns` to `end_ns` after its begin, 0 <= begin <= end <= duration.
TwistRamp cut(const TwistRamp& ramp, std::int64_t begin_ns, std::int64_t end_ns);

/// The motion from the begin of a ramp to a share of its duration, in [0, 1], in the frame at its begin. The heading is quadratic in time and exact; the
/// position is a composite Gauss-Legendre quadrature with eight nodes per panel. A panel turns by at most 0.5 rad, so that the rounding of the sum is
/// the greatest error: below 1e-13 m for a way of some metres. The cost grows with the angle: eight sines and cosines per panel.
PlanarPose displacement(const TwistRamp& ramp, double share = 1.0);

/// The planar pose after a ramp that begins at `start`.
PlanarPose move(const PlanarPose& start, const TwistRamp& ramp);

/// The pose after a ramp that begins at `start`. The motion is in the body's own plane, through its x and y axes.
Pose move(const Pose& start, const TwistRamp& ramp);

}  // namespace hallway
