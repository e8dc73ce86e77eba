// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "slam_plane/core/types.hpp"
#include "slam_plane/thesis/interval.hpp"

namespace hallway::slam_plane::thesis {

/// A segment with a facing side: who stands before it sees `end[kEndA]` on the left. Any frame, which the user names.
struct Segment {
  Vec2 end[2] = {Vec2::Zero(), Vec2::Zero()};  ///< [m]

  Vec2 middle() const { return 0.5 * (end[kEndA] + end[kEndB]); }
  double length() const { return (end[kEndB] - end[kEndA]).norm(); }
  /// Unit, from a to b. NaN for a segment without length.
  Vec2 direction() const { return (end[kEndB] - end[kEndA]) / length(); }
  /// Unit, towards who sees it.
  Vec2 normal() const { return -left_of(direction()); }
};

/// A segment moved into another frame.
Segment operator*(const Pose2& T_to_from, const Segment& segment);

/// What one frame saw of one wall: untransformed, in the robot's frame of that iteration (thesis 4.2.1).
struct TimedObservation {
  Iteration iteration = 0;
  Segment segment;                   ///< robot frame [m]
  Vec2 direction = Vec2(1.0, 0.0);   ///< unit, from the left end to the right one
  double length = 0.0;               ///< [m]
  double z_low = 0.0, z_high = 0.0;  ///< [m]
};

/// Farthest coordinate that is taken [m].
inline constexpr double kMaxCoordinate_m = 1000.0;

/// A wall observation with its iteration. Its ends are numbered as the robot sees them, the left one first, whatever their order was (Rule 14),
/// so its normal faces the robot (Rule 10). Nothing if it has no length, is not finite or lies beyond kMaxCoordinate_m.
std::optional<TimedObservation> make_observation(const WallObservation& seen, Iteration iteration);

/// Those of a frame that make_observation() takes, in their order, and which of the given ones each is.
struct FrameObservations {
  std::vector<TimedObservation> list;
  std::vector<std::size_t> given;

  FrameObservations(std::span<const WallObservation> seen, Iteration iteration);
};

}  // namespace hallway::slam_plane::thesis
