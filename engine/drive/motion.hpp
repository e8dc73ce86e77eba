// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "geometry/se3.hpp"

namespace hallway::drive {

/// A planar velocity in the body's frame: x forward, y left, counter-clockwise turns positive.
struct Twist {
  double forward_m_s = 0.0;
  double lateral_m_s = 0.0;
  double angular_rad_s = 0.0;

  bool operator==(const Twist&) const = default;
};

/// A command is the twist that is wanted.
using Command = Twist;

/// A twist that is linear in time.
struct Ramp {
  Twist from{};
  Twist to{};
  std::int64_t duration_ns = 0;  ///< at least 0

  bool operator==(const Ramp&) const = default;
};

/// A pose in the plane: metres and radians. The yaw is not wrapped.
struct PlanarPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
};

/// Nanoseconds as seconds.
constexpr double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

/// The number at `part` of `whole` on the line from `from` to `to`; exactly `to` at the end, and where `whole` is 0.
double between(double from, double to, std::int64_t part, std::int64_t whole);

/// The twist `t_ns` after the begin of a ramp, 0 <= t_ns <= duration.
Twist twist_at(const Ramp& ramp, std::int64_t t_ns);

/// The part of a ramp from `begin_ns` to `end_ns` after its begin, 0 <= begin <= end <= duration.
Ramp cut(const Ramp& ramp, std::int64_t begin_ns, std::int64_t end_ns);

/// The motion over a whole ramp, in the frame at its begin. The heading is quadratic in time and exact; the position is a composite Gauss-Legendre
/// quadrature with eight nodes per panel. A panel turns by at most 0.5 rad, so that the rounding of the sum is the greatest error: below 1e-13 m for
/// a way of some metres. The cost grows with the angle: eight sines and cosines per panel.
PlanarPose displacement(const Ramp& ramp);

/// The planar pose after a ramp that begins at `start`.
PlanarPose move(const PlanarPose& start, const Ramp& ramp);

/// The pose after a ramp that begins at `start`. The motion is in the body's own plane, through its x and y axes.
Pose move(const Pose& start, const Ramp& ramp);

}  // namespace hallway::drive
