// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/frame/frame_matcher.hpp"
#include "slam_point/core/moving/motion_filter.hpp"
#include "slam_point/core/options.hpp"
#include "slam_point/core/solver/step_schedule.hpp"
#include "slam_point/core/submaps/active_submap.hpp"
#include "slam_point/core/submaps/segment_store.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"
#include "slam_point/core/submaps/submap_overlap.hpp"

namespace hallway::slam_point {

/// Fills one submap after another: closes the active one when it is over, takes up an old one that is in view or opens a new one, averages
/// placed frames into it, and keeps the segments and the steps that place submaps anew.
class SubmapSequence {
 public:
  /// `graph` and `matcher` must outlive it.
  SubmapSequence(const Options& options, SubmapGraph& graph, FrameMatcher& matcher);

  /// Whether a frame sees too little of what the active submap's first frame saw, or the submap has enough frames.
  bool is_over(const Observations& frame) const;

  /// Closes the active submap, and merges its landmarks with duplicates, unless the sensor's tracks distinguish them; the associations of `frame`
  /// follow. Returns how many landmarks were merged.
  std::size_t close(MotionFilter& motion_filter, Frame& frame);

  /// How a submap was taken up.
  struct Taken {
    Pose T_submap_sensor;
    bool reopened = false;
  };
  /// Takes up the old submap that a frame overlaps with most, where it determines a pose in it, else a new one. None is active before.
  Taken take_up(const Observations& frame, const Pose& T_map_sensor);
  /// Takes up a new submap, which begins with the frame at T_map_sensor.
  void open_new(const Pose& T_map_sensor);

  /// Averages a frame aligned at T_submap_sensor into the active submap. Returns how many landmarks it saw.
  std::size_t integrate(const Observations& frame, const Pose& T_submap_sensor);

  /// The activation from which on landmarks lie where the recent submaps put them.
  std::uint64_t local_since() const;
  /// Counts the submaps taken up, the active one included.
  std::uint64_t activation() const { return activation_; }

  ActiveSubmap& active() { return active_; }
  const ActiveSubmap& active() const { return active_; }
  const SubmapGraph& graph() const { return graph_; }
  StepSchedule& schedule() { return schedule_; }
  const SegmentStore& segments() const { return segments_; }

  /// Forgets all submaps; activations go on.
  void clear();

 private:
  std::size_t merge_duplicates(Index submap, MotionFilter& motion_filter, Observations& frame);

  Options options_;
  SubmapGraph& graph_;
  FrameMatcher& matcher_;
  ActiveSubmap active_;
  SegmentStore segments_;
  SubmapOverlap overlap_;
  StepSchedule schedule_;
  SegmentStore::Sightings sightings_;
  std::uint64_t activation_ = 0;
  bool first_of_submap_ = false;  // the next frame integrated begins the active submap
};

}  // namespace hallway::slam_point
