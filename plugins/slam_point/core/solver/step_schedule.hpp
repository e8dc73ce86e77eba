// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "slam_point/core/options.hpp"
#include "slam_point/core/solver/map_step.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// Decides when submaps are placed anew, and does it between frames, in slices.
///
/// After each close a step over the last submaps (Options::window) is due. A step over the whole map is due after a close that
/// follows a loop, every Options::global_period closes, ever more seldom while it changes little, and only when the closes since
/// have earned its work: so the mean cost of a frame does not grow with the map. Both move neighbouring submaps in groups (ReducedSystem::Grouping), but
/// for the newest. Never are both applied from one state: what the
/// one moves, the other would move a second time.
class StepSchedule {
 public:
  explicit StepSchedule(const Options& options);

  /// Before a frame: applies the step that is ready, and begins the one that is due. `noise2_m2`: estimated variance of a coordinate
  /// of an observation. Returns whether a step over the whole map was applied.
  bool apply(SubmapGraph& graph, double noise2_m2);

  /// After a frame: gives one of the steps a bounded amount of work.
  void advance(std::uint64_t frame);

  /// Takes note that `submap` was closed.
  void submap_closed(const SubmapGraph& graph, Index submap);

  /// Takes note that a frame saw what was mapped before the last submaps.
  void saw_old_ground() { on_old_ground_ = true; }
  /// Takes note that two parts of the map became one.
  void parts_joined();

  /// The sensor went on to another part of the map: the last submaps are not those before it.
  void leave_part();

 private:
  /// Steps under way place submaps as they no longer are.
  void drop_steps();
  void begin_window_step(const SubmapGraph& graph);
  void begin_map_step(const SubmapGraph& graph);
  void judge_map_step(const StepCost& cost, double noise2_m2);
  void plan_map_step(const SubmapGraph& graph);

  int global_period_;
  std::size_t window_size_;
  MapStep window_step_;  // over the last submaps
  MapStep map_step_;     // over all of the part
  bool window_step_ready_ = false;
  bool map_step_ready_ = false;
  bool window_step_due_ = false;    // to be begun at the next frame
  bool map_step_due_ = false;       // to be begun when none over the window is under way
  std::vector<Index> window_;       // the last submaps closed, newest last
  std::vector<Index> free_;         // what the step over the window places
  bool on_old_ground_ = false;      // what was mapped before the window has been seen since the last close
  bool was_on_old_ground_ = false;  // the same of the close before
  bool loop_closed_ = false;        // since the last step over the whole map was begun
  double earned_work_ = 0.0;        // multiplications that steps over the whole map may take
  int closes_since_settled_ = 0;
  int closes_since_loop_ = 0;     // since old ground was met after new
  std::size_t window_steps_ = 0;  // begun so far
  std::size_t map_steps_ = 0;     // likewise
  double settled_submaps_ = 0.0;  // how many the last step over the whole map places
  int settle_period_;             // closes between steps over the whole map, as they have proved worth it
};

}  // namespace hallway::slam_point
