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
  explicit MotionFilter(const Options& options);

  /// Finds, for points that are no landmark's, those that follow a landmark known to move, or one that was in view a moment ago and
  /// is not where it was: sets Observation::moving. O(points in view).
  void follow(const SubmapGraph& graph, const Pose& T_map_sensor, std::vector<Observation>& frame);

  /// Looks at the frame's residuals; takes what has proved to move out of `graph` and `active`, and makes its observation
  /// follow it. Returns whether there was any. Before the frame is averaged into the map. O(points in view) but for a
  /// verdict, of which there is at most one a frame.
  bool judge(SubmapGraph& graph, ActiveSubmap& active, const Pose& T_map_sensor, bool planar,
             std::vector<Observation>& frame);

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
  struct Hop {
    double d2 = 0.0;
    std::size_t candidate = 0;
    std::size_t missing = 0;
  };

  void find_candidates(const Pose& T_map_sensor, const std::vector<Observation>& frame);
  void find_missing(const SubmapGraph& graph, const std::vector<Observation>& frame);
  void link_astray(std::vector<Observation>& frame);
  void take_down(const SubmapGraph& graph, const Pose& T_map_sensor, const std::vector<Observation>& frame);
  void suspect_astray(const SubmapGraph& graph, const std::vector<Observation>& frame);
  void suspect_drifting(const SubmapGraph& graph, const Pose& T_map_sensor,
                        const std::vector<Observation>& frame);
  void set_moving(SubmapGraph& graph, ActiveSubmap& active, Index landmark);

  double reach_m_;
  SightingHistory history_;
  MotionWatch watch_;
  MotionVerdict verdict_;
  MotionTracks tracks_;
  std::vector<MotionTracks::Candidate> candidates_;
  std::vector<Missing> missing_;
  std::vector<Hop> hops_;
  std::vector<std::uint64_t> seen_in_;  // landmark -> the frame that saw it, plus one
  std::vector<MotionVerdict::Suspect> suspects_;
  std::vector<MotionVerdict::Finding> findings_;
  std::size_t turn_ = 0;  // whose turn it is to say which time between blocks is looked at
};

}  // namespace hallway::slam_point
