// SPDX-License-Identifier: MIT
#include "slam_point/core/map_step.hpp"

#include <algorithm>
#include <numeric>

#include "slam_point/core/alignment.hpp"

namespace hallway::slam_point {

void MapStep::begin(const SubmapGraph& graph, const std::vector<Pose>& poses, Index newest, bool planar) {
  std::vector<Index> all(graph.submaps.size());
  std::iota(all.begin(), all.end(), Index{0});
  if (newest != kNone) {
    const Index part = graph.submaps[newest].part;
    std::erase_if(all, [&](Index submap) { return graph.submaps[submap].part != part; });
  }
  begin(graph, poses, all, newest, planar);
}

void MapStep::begin(const SubmapGraph& graph, const std::vector<Pose>& poses, const std::vector<Index>& free,
                    Index newest, bool planar) {
  system_.take(graph, free, poses, planar);
  known_ = graph.submaps.size();
  start_.clear();
  members_.clear();
  newest_slot_ = kNone;
  for (const Index submap : system_.free()) {
    if (submap == newest) newest_slot_ = static_cast<Index>(start_.size());
    start_.push_back(poses[submap]);
    members_.push_back(graph.submaps[submap].members.size());
  }
  factor_.begin(start_.size());
  move_.clear();
  next_row_ = 0;
  analysed_ = false;
  ready_ = start_.empty();
  usable_ = false;
  under_way_ = true;
  spent_ = 0.0;
}

bool MapStep::advance(double work) {
  double left = work;
  if (!ready_) make_rows(left);
  if (!ready_ && next_row_ == start_.size() && left > 0.0) {
    if (!analysed_) factor_.analyse();
    analysed_ = true;
    const BlockCholesky::State state = factor_.advance(left);
    ready_ = state != BlockCholesky::State::running;
    if (state == BlockCholesky::State::done) solve();
  }
  spent_ += work - left;
  if (ready_) work_ = spent_;
  return ready_;
}

void MapStep::make_rows(double& left) {
  while (next_row_ < start_.size() && left > 0.0) {
    double used = 0.0;
    const Index row = next_row_++;
    move_.push_back(system_.make_row(row, used, [&](Index column, const ReducedSystem::Block& block) {
      factor_.add(row, column, block);
    }));
    left -= used;
  }
}

void MapStep::solve() {
  factor_.solve(move_);
  usable_ = std::all_of(move_.begin(), move_.end(), [](const auto& move) { return move.allFinite(); });
}

/// Where a submap goes that hangs on the free submap of `slot`, now that it is at `now`.
Pose MapStep::moved(const Pose& now, Index slot) const {
  const Eigen::Quaterniond turn = rotation_exp(-move_[slot].tail<3>());
  const Vec3& from = start_[slot].t;
  return {(turn * now.q).normalized(), from - move_[slot].head<3>() + turn * (now.t - from)};
}

/// Those that were taken down, but for what has been merged into another one, and those that these submaps, the active one and
/// those made since have come to hold.
void MapStep::find_touched(const SubmapGraph& graph) {
  touched_.clear();
  for (const Index landmark : system_.touched()) {
    if (!graph.landmarks[landmark].memberships.empty()) touched_.push_back(landmark);
  }
  const auto add = [&](Index submap, std::size_t first = 0) {
    const std::vector<Member>& members = graph.submaps[submap].members;
    for (std::size_t m = first; m < members.size(); ++m) {
      if (members[m].count > 0) touched_.push_back(members[m].landmark);
    }
  };
  for (Index slot = 0; slot < start_.size(); ++slot) add(system_.free()[slot], members_[slot]);
  if (graph.active() != kNone) add(graph.active());
  if (newest_slot_ != kNone) {
    for (auto submap = static_cast<Index>(known_); submap < graph.submaps.size(); ++submap) add(submap);
  }
  std::sort(touched_.begin(), touched_.end());
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
}

double MapStep::cost(const SubmapGraph& graph, const std::vector<Pose>& poses) const {
  double cost = 0.0;
  for (const Index landmark : touched_) cost += ReducedSystem::cost_of(graph, poses, landmark);
  return cost;
}

StepCost MapStep::apply(const SubmapGraph& graph, std::vector<Pose>& poses) {
  under_way_ = false;
  find_touched(graph);
  StepCost cost;
  cost.before = cost.after = this->cost(graph, poses);
  if (!usable_) return cost;
  before_.clear();
  for (const Index submap : system_.free()) before_.push_back(poses[submap]);
  const auto made = static_cast<std::ptrdiff_t>(newest_slot_ != kNone ? known_ : poses.size());
  before_.insert(before_.end(), poses.begin() + made, poses.end());
  for (Index slot = 0; slot < start_.size(); ++slot) {
    Pose& pose = poses[system_.free()[slot]];
    pose = moved(pose, slot);
  }
  for (std::size_t submap = known_; newest_slot_ != kNone && submap < poses.size(); ++submap)
    poses[submap] = moved(poses[submap], newest_slot_);
  const double after = this->cost(graph, poses);
  if (after < cost.before) {
    cost.after = after;
  } else {
    std::copy(before_.begin() + static_cast<std::ptrdiff_t>(start_.size()), before_.end(),
              poses.begin() + made);
    for (Index slot = 0; slot < start_.size(); ++slot) poses[system_.free()[slot]] = before_[slot];
  }
  return cost;
}

}  // namespace hallway::slam_point
