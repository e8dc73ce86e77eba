// SPDX-License-Identifier: MIT
#include "run/scoring/floor_plan.hpp"

#include <variant>
#include <vector>

#include "sense/wall_plan.hpp"

namespace hallway::run {

eval::FloorPlan floor_plan_at(const sim::Simulator& simulator, double height_m) {
  const sense::WallPlan plan = sense::make_wall_plan(simulator.compiled().partition.surface, {}, height_m);
  std::vector<eval::PlanSegment> segments;
  // An obstacle leads from left to right, as it is seen from the empty side: free space is on the right.
  for (const sense::Obstacle& obstacle : plan.obstacles) segments.push_back({obstacle.to, obstacle.from});
  return eval::FloorPlan(segments);
}

double plan_height_above_body(const sim::Scenario& scenario) {
  for (const sim::SensorSpec& sensor : scenario.sensors) {
    if (const auto* infrared = std::get_if<sense::InfraredSpec>(&sensor))
      return infrared->T_body_sensor.t.z();
  }
  return 0.0;
}

}  // namespace hallway::run
