// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "options/option_table.hpp"
#include "slam_plane/thesis/track_options.hpp"

namespace hallway::slam_plane::thesis {

/// The constants of the algorithm (thesis 4.3–4.5). Lengths in metres, times in iterations.
struct Options {
  double match_angle_deg =
      15.0;  ///< largest angle between an observation and the plane it is associated with (Rule 10)
  double match_distance_m =
      0.3;  ///< largest difference of distances between an observation and one seen just before (Rule 1)
  int recent_iterations = 5;    ///< a plane unseen for longer is looked for in the map alone (Rule 11)
  double map_distance_m = 0.4;  ///< largest distance between an observation and a plane of the map (Rule 11)
  int storage = 1200;           ///< observations kept of a plane
  double trend_hysteresis_m = 0.05;  ///< change of a plane's length that is believed (Rule 18)
  double max_deviation_m =
      0.15;  ///< least standard deviation of a comparison above which no end is static (Rule 13)
  double close_ratio = 1.4;  ///< standard deviations, and times, are alike up to this ratio (Rule 15)
  int min_readings = 10;     ///< of a plane before it joins a submap
  int link_planes = 4;       ///< members that a new submap takes over from an older one, at least 2 (Rule 8)
  int min_interval = 10;     ///< over which a member has to be compared (Rule 31)
  int judge_after = 30;      ///< iterations after a member joined, before that is asked (Rule 32)
  int max_references =
      3;  ///< a plane of so many submaps causes no further one when it is met again (Rule 21)
  int reorder_every = 10;  ///< iterations between two orders of a submap's comparisons (Rule 30)
  int motion_after = 3;    ///< iterations without a position, before the motion model begins (Rule 26)
  double motion_parallel_deg =
      25.0;                  ///< a wall at a smaller angle to the movement does not measure it (Rule 25)
  int roll_back_limit = 50;  ///< iterations that a roll back goes back at most (Rule 33)

  MatchOptions match() const;
  MatchOptions map_match() const;
  TrackOptions track() const;
  CompareOptions compare() const;

  /// Throws std::invalid_argument that names the parameter, its value and its range.
  void validate() const;
};

/// All parameters, in the order of Options.
std::span<const OptionRow<Options>> parameters();

}  // namespace hallway::slam_plane::thesis
