// SPDX-License-Identifier: MIT
#include "slam_point/core/solver/submap_solver.hpp"

#include <limits>
#include <numeric>

#include "slam_point/core/solver/block_cholesky.hpp"
#include "slam_point/core/solver/map_step.hpp"
#include "slam_point/core/solver/reduced_system.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kSettledGain = 1e-9;  // relative fall of the cost that ends the iteration

}  // namespace

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
