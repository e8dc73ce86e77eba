// SPDX-License-Identifier: MIT
#pragma once

#include "eval/floor_plan.hpp"
#include "sim/simulator.hpp"

namespace hallway::run {

/// The plan of a simulator's world at a height: what a level plane cuts from the boundary of what is solid, detail included. Models are
/// left out: their triangles need not be closed. World frame, metres. O(n log n) in the surface.
eval::FloorPlan floor_plan_at(const sim::Simulator& simulator, double height_m);

/// How high the wall is that a robot follows: as its first infrared sensor, metres above the body's origin; 0 where it has none.
double plan_height_above_body(const sim::Scenario& scenario);

}  // namespace hallway::run
