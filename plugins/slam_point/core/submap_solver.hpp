// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "slam_point/core/map_step.hpp"
#include "slam_point/core/reduced_system.hpp"

namespace hallway::slam_point {

/// Places some submaps by least squares, the others held; see ReducedSystem. Buffers are kept between calls.
class WindowSolver {
 public:
  /// One Gauss-Newton step for `free` (distinct submaps), with a dense system: for a few dozen. Kept in `poses` only
  /// when it lowers the sum of squares over their landmarks. In `planar` data only x, y and yaw move.
  StepCost step(const SubmapGraph& graph, const std::vector<Index>& free, bool planar,
                std::vector<Pose>& poses);

  /// Landmarks of the submaps of the last step, each once.
  const std::vector<Index>& touched() const { return system_.touched(); }

 private:
  StepCost take(const SubmapGraph& graph, std::vector<Pose>& poses);

  ReducedSystem system_;
  std::vector<Pose> previous_;  // slot -> pose before the step
  Eigen::VectorXd gradient_;
  Eigen::VectorXd move_;
  Eigen::MatrixXd dense_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

/// Multiplications that the factorisation of one step over all submaps takes.
double step_work(const SubmapGraph& graph, bool planar);

/// Steps over all submaps (MapStep) until the sum of squares settles; at most `max_steps`. Returns the steps taken.
int settle(const SubmapGraph& graph, bool planar, int max_steps, std::vector<Pose>& poses);

}  // namespace hallway::slam_point
