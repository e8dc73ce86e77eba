// SPDX-License-Identifier: MIT
#pragma once

#include "wall_follower/core/options.hpp"
#include "wall_follower/core/senses.hpp"

namespace hallway::wall_follower {

/// What an opening leads to.
enum class Opening {
  covered,  ///< nowhere: something stands in it that infrared does not see
  room,     ///< if the wall goes on behind it
  hallway
};

/// What a sweep measures of an opening.
struct OpeningView {
  /// How far the free space reaches into the opening, from the robot; infinite where nothing was heard [m].
  double depth_m = 0.0;
  int heard = 0;  ///< pings in the window with an echo
  int pings = 0;  ///< pings in the window
};

/// The depth is the middle one of the ranges in the window: of an even number the upper one. So neither a ping that is lost nor one of an echo that is not there counts.
/// @param into  direction into the opening, in the body frame [rad]
OpeningView view_of(const Sweep& sweep, double into, const Options& options);

/// The rule (thesis 2.2.4: "calibrated to know if it is detecting a room or an open hallway"): an opening is covered where the space ends right behind the line of the wall, a room where it ends
/// before `room_depth_m`, else a hallway. @param wall_m  distance of the wall's line from the robot
Opening classify(const OpeningView& view, double wall_m, const Options& options);

}  // namespace hallway::wall_follower
