// SPDX-License-Identifier: MIT
#include "slam_point/core/submap_solver.hpp"

#include <limits>
#include <numeric>

#include "slam_point/core/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kSettledGain = 1e-9;  // relative fall of the cost that ends the iteration

}  // namespace

StepCost WindowSolver::step(const SubmapGraph& graph, const std::vector<Index>& free, bool planar,
                            std::vector<Pose>& poses) {
  system_.take(graph, free, poses, planar);
  const StepCost none{system_.cost(), system_.cost()};
  const auto slots = static_cast<Index>(system_.free().size());
  if (slots == 0) return none;
  const Eigen::Index n = 6 * static_cast<Eigen::Index>(slots);
  dense_.setZero(n, n);
  gradient_.resize(n);
  double work = 0.0;
  for (Index row = 0; row < slots; ++row) {
    const Eigen::Index at = 6 * static_cast<Eigen::Index>(row);
    gradient_.segment<6>(at) =
        system_.make_row(row, work, [&](Index column, const ReducedSystem::Block& block) {
          dense_.block<6, 6>(at, 6 * static_cast<Eigen::Index>(column)) = block;
        });
  }
  factor_.compute(dense_);
  if (factor_.info() != Eigen::Success) return none;
  move_ = factor_.solve(gradient_);
  return move_.allFinite() ? take(graph, poses) : none;
}

StepCost WindowSolver::take(const SubmapGraph& graph, std::vector<Pose>& poses) {
  previous_.clear();
  for (std::size_t slot = 0; slot < system_.free().size(); ++slot) {
    const auto move = move_.segment<6>(6 * static_cast<Eigen::Index>(slot));
    Pose& pose = poses[system_.free()[slot]];
    previous_.push_back(pose);
    pose.t -= move.head<3>();
    pose.q = (rotation_exp(-move.tail<3>()) * pose.q).normalized();
  }
  StepCost cost{system_.cost(), 0.0};
  for (const Index landmark : system_.touched()) cost.after += ReducedSystem::cost_of(graph, poses, landmark);
  if (cost.after < cost.before) return cost;
  for (std::size_t slot = 0; slot < previous_.size(); ++slot) poses[system_.free()[slot]] = previous_[slot];
  cost.after = cost.before;
  return cost;
}

double step_work(const SubmapGraph& graph, bool planar) {
  std::vector<Index> all(graph.submaps.size());
  std::iota(all.begin(), all.end(), Index{0});
  ReducedSystem system;
  system.take(graph, all, graph.poses, planar);
  BlockCholesky factor;
  factor.begin(system.free().size());
  double rows_work = 0.0;
  for (Index row = 0; row < system.free().size(); ++row) {
    system.make_row(row, rows_work,
                    [&](Index column, const ReducedSystem::Block& block) { factor.add(row, column, block); });
  }
  if (system.free().empty()) return 0.0;
  factor.analyse();
  return factor.work();
}

int settle(const SubmapGraph& graph, bool planar, int max_steps, std::vector<Pose>& poses) {
  MapStep step;
  for (int steps = 0; steps < max_steps; ++steps) {
    step.begin(graph, poses, kNone, planar);
    while (!step.advance(std::numeric_limits<double>::max())) {
    }
    const StepCost cost = step.apply(graph, poses);
    if (cost.after == cost.before) return steps;
    if (cost.before - cost.after <= kSettledGain * cost.before) return steps + 1;
  }
  return max_steps;
}

}  // namespace hallway::slam_point
