// SPDX-License-Identifier: MIT
#include "run/simulated_source.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/text.hpp"
#include "run/abi_pose.hpp"

namespace hallway::run {

SimulatedSource::SimulatedSource(const sim::Simulator& simulator) : simulator_(simulator) {
  const sim::Scenario& scenario = simulator.scenario();
  if (scenario.sensors.size() != 1) {
    throw Error(
        ErrorCode::kBadInput,
        fmt::format(
            "a run takes exactly one sensor, a [sensor.NAME] of the scenario or, where it has none, an "
            "hw_sensor of its map; there are {}",
            scenario.sensors.size()),
        {.file = printable(scenario.file)});
  }
  const sense::PointSensorSpec& spec = scenario.sensors.front();
  sensor_.name = spec.name;
  sensor_.T_body_sensor = abi_pose(spec.T_body_sensor);
  sensor_.horizontal_fov = spec.horizontal_fov;
  sensor_.vertical_fov = spec.vertical_fov;
  sensor_.min_range_m = spec.min_range_m;
  sensor_.max_range_m = spec.max_range_m;
  for (int axis = 0; axis < 3; ++axis) sensor_.noise_m[axis] = spec.noise_m[axis];
  landmarks_.emplace();
  for (const Vec3& place : simulator.landmarks()) {
    const auto id = static_cast<std::uint32_t>(landmarks_->size());
    landmarks_->push_back({.id = id,
                           .position_m = {place.x(), place.y(), place.z()},
                           .moving = simulator.moving_landmarks().moves(id)});
  }
}

void SimulatedSource::read(std::uint32_t iteration, SourceFrame& frame) {
  const sim::Frame step = simulator_.step(iteration);
  frame.t_ns = step.t_ns;
  frame.T_world_body = step.T_world_body;
  frame.orientation_known = true;
  frame.observations.clear();
  for (const sense::PointObservation& seen : step.readings.front().observations) {
    frame.observations.push_back(
        {.landmark = seen.landmark, .point = {seen.point.x(), seen.point.y(), seen.point.z()}});
  }
}

}  // namespace hallway::run
