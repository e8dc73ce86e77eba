// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/frame/frame_matcher.hpp"
#include "slam_point/core/moving/motion_tracks.hpp"
#include "slam_point/core/moving/motion_verdict.hpp"
#include "slam_point/core/moving/motion_watch.hpp"
#include "slam_point/core/moving/sighting_history.hpp"
#include "slam_point/core/submaps/active_submap.hpp"

namespace hallway::slam_point {

/// Keeps landmarks that move out of the map, continuously (thesis 6.5.3, which checks once, when a group is made): a landmark that
/// begins to move later is found too.
///
/// Three steps: MotionWatch suspects, at a few operations per sighting; MotionVerdict decides, from raw sightings; what moves is taken
/// out of all submaps and from then on followed by MotionTracks. Per frame, after the frame is placed: follow(), then new
/// landmarks are made of what is left, then judge().
class MotionFilter {
 public:
  /// `graph` must outlive it.
  MotionFilter(const Options& options, SubmapGraph& graph);

  /// Finds, for points that are no landmark's, those that follow a landmark known to move, or one that was in view a moment ago and
  /// is not where it was: sets Observation::moving. O(points in view).
  void follow(const Pose& T_map_sensor, Observations& frame);

  /// Looks at the frame's residuals; takes what has proved to move out of the graph and `active`, and makes its observation
  /// follow it. Returns whether there was any. Before the frame is averaged into the map. O(points in view) but for a
  /// verdict, of which there is at most one a frame.
  bool judge(ActiveSubmap& active, const Pose& T_map_sensor, Observations& frame);

  /// Whether two landmarks that have come close are known to be two: one frame saw both.
  bool are_two(Index a, Index b) const { return history_.saw_together(a, b); }
  /// Tells that `from` turned out to be `into`.
  void merged(Index from, Index into) { history_.rename(from, into); }

  /// The landmarks that move.
  const std::vector<MotionTracks::Track>& tracks() const { return tracks_.tracks(); }

  void clear();

 private:
  /// A landmark that was seen by the frame before and not by this one.
  struct Missing {
    Index landmark = kNone;
    Vec3 place = Vec3::Zero();  // map frame, where it was
  };

  void find_candidates(const Pose& T_map_sensor, const Observations& frame);
  void find_missing(const Observations& frame);
  void link_astray(Observations& frame);
  void record(const Pose& T_map_sensor, const Observations& frame);
  void suspect_astray(const Observations& frame);
  void suspect_drifting(const Pose& T_map_sensor, const Observations& frame);
  void take_out(ActiveSubmap& active, Index landmark);

  SubmapGraph& graph_;
  double reach_m_;
  SightingHistory history_;
  MotionWatch watch_;
  MotionVerdict verdict_;
  MotionTracks tracks_;
  std::vector<MotionTracks::Candidate> candidates_;
  std::vector<Missing> missing_;
  std::vector<Pairing> hops_;           // of candidates and missing landmarks
  std::vector<std::uint64_t> seen_in_;  // landmark -> the frame that saw it, plus one
  std::vector<MotionVerdict::Suspect> suspects_;
  std::vector<MotionVerdict::Finding> findings_;
  std::size_t turn_ = 0;  // whose turn it is to say which time between blocks is looked at
};

}  // namespace hallway::slam_point
