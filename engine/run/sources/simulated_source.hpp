// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

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
  void add_reading(const sense::PointSensorSpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;
  void add_reading(const sense::PlaneSensorSpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;

  const sim::Simulator& simulator_;
  /// By sensor: the number of its first one in true_planes(); none where it sees no planes.
  std::vector<std::optional<std::uint64_t>> first_true_plane_;
};

}  // namespace hallway::run
