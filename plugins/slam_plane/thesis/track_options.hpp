// SPDX-License-Identifier: MIT
#pragma once

namespace hallway::slam_plane::thesis {

/// What an observation may differ by from a wall that it is associated with.
struct MatchOptions {
  double angle_deg = 15.0;    ///< largest angle between the normals (Rule 10)
  double distance_m = 0.3;    ///< largest difference of the lines' distances
  double overlap = 0.5;       ///< least overlap of the extents, as a share of the shorter one
  double slack_m = 0.1;       ///< that is added to the overlap
  int recent_iterations = 5;  ///< a track not seen for longer is not matched without a pose
};

/// What a track keeps, and when it splits its time.
struct TrackOptions {
  int capacity = 1200;     ///< observations kept, at most 16384
  int gap_iterations = 2;  ///< unseen for at most so long, an interval goes on
  int trend_window =
      5;  ///< observations in the moving average of the length; the longest and the shortest one do not count
  double trend_hysteresis_m = 0.05;  ///< change of that average that is believed
};

/// How two tracks are compared.
struct CompareOptions {
  int size_backing = 3;  ///< observations that have to reach a size (Rule 20), 1 to 4; 1: the filter is off
  double size_tolerance_m = 0.05;  ///< but for this
  int min_shared = 3;              ///< least observations that a comparison is made from
  double max_deviation_m = 0.5;    ///< least standard deviation above which no end is static; 0: no bound
  double close_ratio = 1.4;        ///< standard deviations, and times, are alike up to this ratio (Rule 15)
  double parallel_deg = 10.0;      ///< planes are parallel up to this angle
};

}  // namespace hallway::slam_plane::thesis
