// SPDX-License-Identifier: MIT
#pragma once

#include "run/sources/source.hpp"
#include "sim/simulator.hpp"

namespace hallway::run {

/// The frames of a simulated robot.
class SimulatedSource : public Source {
 public:
  /// Keeps a reference to the simulator. Throws Error{kBadInput} if the scenario has no sensor.
  explicit SimulatedSource(const sim::Simulator& simulator);

  /// Makes true planes known also of a sensor of points: the walls at its height.
  void add_walls();

  std::uint32_t iterations() const override { return simulator_.scenario().steps; }

 private:
  void fill(std::uint32_t iteration, SourceFrame& frame) override;
  void add_sensor(const sense::PointSensorSpec& spec);
  void add_sensor(const sense::PlaneSensorSpec& spec);
  std::uint64_t add_true_planes(std::vector<log::TruePlane> planes);

  const sim::Simulator& simulator_;
  std::vector<std::uint64_t> first_true_plane_;  ///< by sensor: the number of its first one in true_planes()
};

}  // namespace hallway::run
