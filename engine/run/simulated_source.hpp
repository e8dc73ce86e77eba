// SPDX-License-Identifier: MIT
#pragma once

#include "run/source.hpp"
#include "sim/simulator.hpp"

namespace hallway::run {

/// The frames of a simulated robot.
class SimulatedSource : public Source {
 public:
  /// Keeps a reference to the simulator. Throws Error{kBadInput} unless the scenario has exactly one sensor.
  explicit SimulatedSource(const sim::Simulator& simulator);

  /// Makes true planes known also of a sensor of points: the walls at its height.
  void add_walls();

  std::uint32_t iterations() const override { return simulator_.scenario().steps; }
  void read(std::uint32_t iteration, SourceFrame& frame) override;

 private:
  void take(const sense::PointSensorSpec& spec);
  void take(const sense::PlaneSensorSpec& spec);
  void set_walls(const sense::WallPlan& plan);
  void set_faces(const sense::FacePlan& plan);

  const sim::Simulator& simulator_;
};

}  // namespace hallway::run
