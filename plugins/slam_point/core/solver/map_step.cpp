// SPDX-License-Identifier: MIT
#include "slam_point/core/solver/map_step.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kConvergedGain = 1e-9;  // relative fall of the cost that ends the iteration

}  // namespace

void MapStep::begin(const SubmapGraph& graph, const std::vector<Pose>& poses, Index newest,
                    const Grouping& grouping) {
  std::vector<Index> all(graph.submaps.size());
  std::iota(all.begin(), all.end(), Index{0});
  if (newest != kNone) {
    const Index part = graph.submaps[newest].part;
    std::erase_if(all, [&](Index submap) { return graph.submaps[submap].part != part; });
  }
  begin(graph, poses, all, newest, grouping);
}

void MapStep::begin(const SubmapGraph& graph, const std::vector<Pose>& poses, const std::vector<Index>& free,
                    Index newest, const Grouping& grouping) {
  system_.take(graph, free, poses, grouping);
  known_ = graph.submaps.size();
  members_.clear();
  newest_row_ = newest == kNone ? kNone : system_.row_of(newest);
  for (const Index submap : system_.free()) members_.push_back(graph.submaps[submap].members.size());
  factor_.begin(system_.rows());
  move_.clear();
  next_row_ = 0;
  analysed_ = false;
  ready_ = system_.rows() == 0;
  usable_ = false;
  under_way_ = true;
  spent_ = 0.0;
}

bool MapStep::advance(double work) {
  double left = work;
  if (!ready_) make_rows(left);
  if (!ready_ && next_row_ == system_.rows() && left > 0.0) {
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
  while (next_row_ < system_.rows() && left > 0.0) {
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

/// Where a submap goes that hangs on a row, now that it is at `now`.
Pose MapStep::moved(const Pose& now, Index row) const {
  const Quat turn = rotation_exp(-move_[row].tail<3>());
  const Vec3& from = system_.origin(row);
  return {(turn * now.q).normalized(), from - move_[row].head<3>() + turn * (now.t - from)};
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
  for (std::size_t f = 0; f < members_.size(); ++f) add(system_.free()[f], members_[f]);
  if (graph.active() != kNone) add(graph.active());
  if (newest_row_ != kNone) {
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

/// Moves the free submaps, and those made since by what `newest` is moved.
void MapStep::move(std::vector<Pose>& poses) {
  before_.clear();
  const auto move_by = [&](Index submap, Index row) {
    before_.push_back({submap, poses[submap]});
    poses[submap] = moved(poses[submap], row);
  };
  for (const Index submap : system_.free()) move_by(submap, system_.row_of(submap));
  if (newest_row_ == kNone) return;
  for (auto submap = static_cast<Index>(known_); submap < poses.size(); ++submap)
    move_by(submap, newest_row_);
}

void MapStep::move_back(std::vector<Pose>& poses) const {
  for (const Before& before : before_) poses[before.submap] = before.pose;
}

/// The sum of squares over touched_ before move() and after it.
StepCost MapStep::compare(const SubmapGraph& graph, const std::vector<Pose>& poses) {
  now_.begin(poses.size());
  past_.begin(poses.size());
  for (const Before& before : before_) past_.set(before.submap, before.pose);
  StepCost cost;
  for (const Index landmark : touched_) add_costs(graph, poses, landmark, cost);
  return cost;
}

/// Adds ReducedSystem::cost_of() a landmark before and after, in one round over its places.
void MapStep::add_costs(const SubmapGraph& graph, const std::vector<Pose>& poses, Index landmark,
                        StepCost& cost) {
  const std::vector<Membership>& memberships = graph.landmarks[landmark].memberships;
  const Membership& front = memberships.front();
  const Vec3 origin = now_.of(front.submap, poses) * graph.submaps[front.submap].members[front.member].mean;
  double weight = 0.0;
  double squares_before = 0.0;
  double squares_after = 0.0;
  Vec3 sum_before = Vec3::Zero();
  Vec3 sum_after = Vec3::Zero();
  for (const Membership& at : memberships) {
    const Member& member = graph.submaps[at.submap].members[at.member];
    const double own = member.weight();
    const Vec3 after = now_.of(at.submap, poses) * member.mean - origin;
    Vec3 before = after;
    if (past_.has(at.submap)) before = past_.of(at.submap, poses) * member.mean - origin;
    weight += own;
    sum_after += own * after;
    squares_after += own * after.squaredNorm();
    sum_before += own * before;
    squares_before += own * before.squaredNorm();
  }
  cost.before += std::max(0.0, squares_before - sum_before.squaredNorm() / weight);
  cost.after += std::max(0.0, squares_after - sum_after.squaredNorm() / weight);
}

StepCost MapStep::apply(const SubmapGraph& graph, std::vector<Pose>& poses) {
  under_way_ = false;
  find_touched(graph);
  StepCost cost;
  if (graph.is_directional() || !usable_) cost.before = cost.after = this->cost(graph, poses);
  if (!usable_) return cost;
  move(poses);
  if (graph.is_directional()) {
    cost.after = this->cost(graph, poses);
  } else {
    cost = compare(graph, poses);
  }
  if (cost.after < cost.before) return cost;
  cost.after = cost.before;
  move_back(poses);
  return cost;
}

double step_work(const SubmapGraph& graph) {
  ReducedSystem system;
  BlockCholesky factor;
  system.take_all(graph, factor);
  return system.free().empty() ? 0.0 : factor.work();
}

int optimise(const SubmapGraph& graph, int max_steps, std::vector<Pose>& poses) {
  MapStep step;
  for (int steps = 0; steps < max_steps; ++steps) {
    step.begin(graph, poses, kNone);
    while (!step.advance(std::numeric_limits<double>::max())) {
    }
    const StepCost cost = step.apply(graph, poses);
    if (cost.after == cost.before) return steps;
    if (cost.before - cost.after <= kConvergedGain * cost.before) return steps + 1;
  }
  return max_steps;
}

}  // namespace hallway::slam_point
