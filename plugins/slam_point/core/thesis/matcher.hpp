// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slam_point/core/fit/robust_fit.hpp"
#include "slam_point/core/frame/frame.hpp"
#include "slam_point/core/index/pairing.hpp"
#include "slam_point/core/index/point_index.hpp"
#include "slam_point/core/options.hpp"
#include "slam_point/core/thesis/options.hpp"
#include "slam_point/core/thesis/tracks.hpp"

namespace hallway::slam_point::thesis {

/// Finds which landmark each point of a frame is: first among those of the last iterations, as they were seen, then in the map (thesis
/// 6.2.5 and 6.5.1). One-to-one, the nearest pair first.
class Matcher {
 public:
  Matcher(const slam_point::Options& common, const Options& options);

  /// Matches a frame to the newest observation of each landmark seen in the last iterations before `now`. `moved`, T_last_now, is the motion
  /// expected of one iteration; Matching::nearest takes none. O(points in view).
  void match_recent(Tracks& tracks, Iteration now, const Pose& moved, Observations& frame);

  /// Matches what is left to the mapped landmarks, from T_map_sensor.
  void match_map(const Tracks& tracks, const Pose& T_map_sensor, Observations& frame);

 private:
  void match_to_recent(double bound_m, const Pose& moved, Observations& frame);
  void list_recent(Tracks& tracks, Iteration now, const Pose& moved);
  bool fit_motion(const Observations& frame, Pose& moved);
  void take_nearest_first(Observations& frame, Index tracks);

  slam_point::Options common_;
  Options options_;
  PointIndex grid_;
  std::vector<Index> recent_;
  std::vector<Vec3> recent_points_;  // in the frame of the last iteration, where the motion moves them
  std::vector<Pairing> pairings_;    // of observations and tracks
  std::vector<std::uint8_t> taken_;
  std::vector<Index> place_of_;  // track -> in recent_
  std::vector<Pair> pairs_;
};

}  // namespace hallway::slam_point::thesis
