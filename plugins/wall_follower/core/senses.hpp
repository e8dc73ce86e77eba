// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::wall_follower {

/// The five infrared detectors, by where they look.
enum Look : std::size_t { kLeft, kFrontLeft, kFront, kFrontRight, kRight, kLooks };

/// Where a detector is on the body and where it looks.
struct Mount {
  Vec2 place = Vec2::Zero();  ///< in the body frame: forward, left [m]
  double direction = 0.0;     ///< from forward to the left [rad]

  /// The point of the body frame at that range.
  Vec2 point(double range_m) const;
};

/// What is known of the robot before it starts.
struct Body {
  std::array<Mount, kLooks> infrared;
  double wheel_base_m = 0.24;  ///< between the tracks
};

/// One ping of the sonar.
struct Ping {
  double direction;  ///< in the body frame, from forward to the left [rad]
  double range_m;    ///< infinite: no echo
};

/// A sweep of the sonar.
struct Sweep {
  std::int64_t begin_ns = 0;
  std::vector<Ping> pings;
};

/// What touches the robot.
struct Bump {
  bool left = false;   ///< in front, to the left of the middle
  bool right = false;  ///< in front, to the right
  bool behind = false;
  bool left_side = false;
  bool right_side = false;

  /// Whether something is in the way, in front or behind.
  bool in_the_way() const { return left || right || behind; }
};

/// What one iteration knows.
struct Senses {
  std::int64_t t_ns = 0;
  /// Readings of each detector since the last iteration, oldest first [m]; infinite: nothing seen. NaN: nearer than it can measure.
  std::array<std::vector<double>, kLooks> infrared;
  std::optional<Sweep> sweep;  ///< where one has ended
  Bump bump;
  double left_m = 0.0;   ///< way of the left track since the start, forward positive, by its encoder
  double right_m = 0.0;  ///< likewise of the right one
};

}  // namespace hallway::wall_follower
