// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "slam_plane/core/types.hpp"

namespace hallway::slam_plane {

/// An observation of the frame under way, with the wall that it is associated with. Robot frame.
struct AssociatedObservation {
  Vec2 end[2];          ///< a and b [m]
  Vec2 middle;          ///< [m]
  Vec2 direction;       ///< unit, from a to b
  double length = 0.0;  ///< [m]
  double z_low = 0.0;
  double z_high = 0.0;
  std::size_t given = 0;            ///< its index among the observations given
  bool corner[2] = {false, false};  ///< judged to be a true corner, by this frame's geometry
  bool hidden[2] = {false, false};  ///< judged to be where something in front hides the rest
  Index wall = kNone;               ///< kNone: unassociated
  bool outlier = false;             ///< it does not lie where its wall does

  /// Whether it tells where its wall is.
  bool is_evidence() const { return wall != kNone && !outlier; }
};

/// The observations of a frame, in their order, without those that cannot be of a wall: not finite, too far, too short, or turning their back to
/// the robot.
std::vector<AssociatedObservation> unassociated(std::span<const WallObservation> given);

}  // namespace hallway::slam_plane
