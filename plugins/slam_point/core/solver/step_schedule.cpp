// SPDX-License-Identifier: MIT
#include "slam_point/core/solver/step_schedule.hpp"

#include <algorithm>

namespace hallway::slam_point {
namespace {

constexpr double kWorthwhileGain =
    1.0;  // fall of the cost, in variances of an observation, for which a step over the whole map is repeated soon
constexpr double kWorkPerClose = 3e5;  // multiplications for steps over the whole map that a close earns
constexpr double kMostClosesSaved = 100.0;
constexpr double kMostSteps = 4.0;           // over the whole map, that can be saved up
constexpr double kWindowWorkPerFrame = 3e5;  // multiplications on the step over the window: 0.1 ms
constexpr double kMapWorkPerFrame =
    4e5;  // likewise over the whole map: more, since late steps make later ones later
constexpr int kMaxSettlePeriod = 1 << 20;
constexpr std::size_t kGroup = 3;  // neighbouring submaps that a step moves as one
constexpr std::size_t kAloneInWindow =
    4;  // but for the newest, whose place to each other is still to be found

/// The groups of a step. Those of step after step begin elsewhere, so that no two submaps stay as they are to each other.
MapStep::Grouping groups(std::size_t step, std::size_t alone) {
  return {kGroup, 1 + step % kGroup, alone};
}

}  // namespace

StepSchedule::StepSchedule(const Options& options)
    : global_period_(options.global_period),
      window_size_(static_cast<std::size_t>(options.window)),
      settle_period_(options.global_period) {}

bool StepSchedule::apply(SubmapGraph& graph, double noise2_m2) {
  bool settled = false;
  if (window_step_.under_way() && window_step_ready_) {
    const StepCost cost = window_step_.apply(graph, graph.poses);
    if (cost.after < cost.before) graph.take_moved(window_step_.touched());
  } else if (map_step_.under_way() && map_step_ready_) {
    const StepCost cost = map_step_.apply(graph, graph.poses);
    if (cost.after < cost.before) graph.take_moved(map_step_.touched());
    judge_map_step(cost, noise2_m2);
    settled = true;
  }
  if (window_step_due_) {
    begin_window_step(graph);
  } else if (map_step_due_ && !window_step_.under_way()) {
    begin_map_step(graph);
  }
  return settled;
}

void StepSchedule::advance(std::uint64_t frame) {
  const bool window = window_step_.under_way() && !window_step_ready_;
  const bool map = map_step_.under_way() && !map_step_ready_;
  if (window && (!map || frame % 2 == 0)) {
    window_step_ready_ = window_step_.advance(kWindowWorkPerFrame);
  } else if (map) {
    map_step_ready_ = map_step_.advance(kMapWorkPerFrame);
  }
}

void StepSchedule::submap_closed(const SubmapGraph& graph, Index submap) {
  std::erase(window_, submap);
  if (window_.size() == window_size_) window_.erase(window_.begin());
  window_.push_back(submap);
  // Where closes follow each other faster than a step is computed, the next one takes in what this one leaves out.
  window_step_due_ = !window_step_.under_way();
  plan_map_step(graph);
}

void StepSchedule::parts_joined() {
  drop_steps();
  loop_closed_ = true;
}

void StepSchedule::leave_part() {
  window_.clear();
  drop_steps();
}

void StepSchedule::drop_steps() {
  window_step_ = MapStep();
  map_step_ = MapStep();
  window_step_ready_ = window_step_due_ = false;
  map_step_ready_ = map_step_due_ = false;
}

/// Of the submaps closed last and the one that is active.
void StepSchedule::begin_window_step(const SubmapGraph& graph) {
  free_ = window_;
  if (std::find(free_.begin(), free_.end(), graph.active()) == free_.end()) free_.push_back(graph.active());
  window_step_.begin(graph, graph.poses, free_, graph.active(), groups(window_steps_++, kAloneInWindow));
  window_step_ready_ = false;
  window_step_due_ = false;
}

void StepSchedule::begin_map_step(const SubmapGraph& graph) {
  map_step_.begin(graph, graph.poses, graph.active(), groups(map_steps_++, 0));
  map_step_ready_ = false;
  map_step_due_ = false;
  settled_submaps_ = static_cast<double>(graph.submaps.size());
  loop_closed_ = false;
  closes_since_settled_ = 0;
}

void StepSchedule::judge_map_step(const StepCost& cost, double noise2_m2) {
  earned_work_ -= map_step_.work();
  const bool worth_it = cost.before - cost.after > kWorthwhileGain * noise2_m2;
  // While a loop is being closed each close tells more, so one step of little use does not mean that the next is.
  const bool looping = closes_since_loop_ < 2 * static_cast<int>(window_size_);
  settle_period_ = worth_it || looping ? global_period_ : std::min(2 * settle_period_, kMaxSettlePeriod);
}

/// Decides at a close whether a step over the whole map is to follow.
void StepSchedule::plan_map_step(const SubmapGraph& graph) {
  ++closes_since_settled_;
  // The share of a close stays the same in a map of any size. The work of a step grows with at most the cube.
  const double growth = static_cast<double>(graph.submaps.size()) / std::max(1.0, settled_submaps_);
  const double work = map_step_.work() * growth * growth * growth;
  earned_work_ =
      std::min(earned_work_ + kWorkPerClose, std::max(kMostSteps * work, kMostClosesSaved * kWorkPerClose));
  // Old ground after new: what the loop tells is not in the map yet.
  ++closes_since_loop_;
  if (on_old_ground_ && !was_on_old_ground_) {
    settle_period_ = global_period_;
    closes_since_loop_ = 0;
  }
  was_on_old_ground_ = on_old_ground_;
  loop_closed_ = loop_closed_ || on_old_ground_;
  on_old_ground_ = false;
  map_step_due_ = global_period_ != 0 && loop_closed_ && !map_step_.under_way() &&
                  closes_since_settled_ >= settle_period_ && earned_work_ >= work;
}

}  // namespace hallway::slam_point
