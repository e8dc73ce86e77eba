// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "options/option_table.hpp"

namespace hallway::wall_follower {

/// Every tunable of Follower.
struct Options {
  double speed_m_s = 0.3;        ///< along a wall
  double turn_rad_s = 1.2;       ///< of the tracks, in a turn on the spot
  double distance_m = 0.47;      ///< of the robot's middle from the wall
  double front_m = 0.34;         ///< a wall nearer than this to the detector in front ends the way
  double gone_m = 0.75;          ///< a wall farther than this from the detector to the right is none
  double least_step_m = 0.1;     ///< least discontinuity
  double confirm_m = 0.1;        ///< way behind a discontinuity after which it is certain
  double edge_m = 0.06;          ///< way without a wall after which it has ended
  double fit_m = 0.45;           ///< way whose points make the wall's line
  double longest_pass_m = 1.17;  ///< an opening longer than this is no doorway
  double turn_slip = 0.12;       ///< share of a turn that the tracks lose, at first
  double cover_m =
      0.4;  ///< an echo nearer than this behind the wall's line is of something dark, and no opening
  double room_depth_m = 4.5;       ///< an opening whose free space reaches beyond this is a hallway
  double sweep_window_deg = 22.5;  ///< pings within this of the direction into the opening count
  double bump_back_m = 0.1;        ///< way back after a bump
  double match_score = 6.5;        ///< of the landmarks that close a loop
  double match_margin = 2.0;       ///< that the next best place must be below it
  double least_lap_m = 3.0;        ///< a loop is not shorter
  double drift_m = 0.4;            ///< how far the way of a lap may be from leading back
  double drift_per_m = 0.05;       ///< likewise, for each metre of it
  int exploration = 1;             ///< which opening is next after a loop, an Exploration
  int most_nodes = 400;            ///< of a chart
};

/// The options as a host shows them. Defaults are those of default-made Options.
std::span<const OptionRow<Options>> parameters();

}  // namespace hallway::wall_follower
