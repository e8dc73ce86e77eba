// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_point/core/solver/map_step.hpp"
#include "slam_point/core/solver/reduced_system.hpp"

namespace hallway::slam_point {

/// Multiplications that the factorisation of one step over all submaps takes.
double step_work(const SubmapGraph& graph, bool planar);

/// Steps over all submaps (MapStep) until the sum of squares settles; at most `max_steps`. Returns the steps taken.
int settle(const SubmapGraph& graph, bool planar, int max_steps, std::vector<Pose>& poses);

}  // namespace hallway::slam_point
