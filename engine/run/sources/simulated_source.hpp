// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "run/sources/source.hpp"
#include "sense/describe.hpp"
#include "sim/driven_robot.hpp"
#include "sim/simulator.hpp"

namespace hallway::run {

/// The frames of a simulated robot, which its path moves, or a drive that obeys.
class SimulatedSource : public Source {
 public:
  /// Keeps a reference to the simulator. Throws Error{kBadInput} if the scenario has no sensor.
  explicit SimulatedSource(const sim::Simulator& simulator);

  /// Makes true planes known also of a sensor of points: the walls at its height.
  void add_walls();

  std::uint32_t iterations() const override { return simulator_.scenario().steps; }
  bool is_closed_loop() const override { return robot_.has_value(); }
  void obey(const sim::DriveAnswer& answer) override;
  bool is_moving() const override { return robot_ && robot_->is_moving(); }
  DriveNotes take_drive_notes() override { return std::exchange(notes_, {}); }
  std::optional<sim::DriveCounts> drive_counts() const override;
  std::optional<eval::FloorPlan> floor_plan() const override;

 private:
  void fill(std::uint32_t iteration, SourceFrame& frame) override;
  void move_to(std::uint32_t iteration);
  void add_sensor(const sense::PointSensorSpec& spec);
  void add_sensor(const sense::PlaneSensorSpec& spec);
  void add_sensor(const sim::EncoderSpec& spec);
  void add_sensor(const sense::LidarSpec& spec);
  void add_sensor(const sense::GnssSpec& spec);
  /// Of a sensor whose facts are all in its specification, and which sees no planes.
  template <typename Spec>
  void add_sensor(const Spec& spec) {
    facts_.sensors.push_back(sense::describe(spec, static_cast<std::uint32_t>(facts_.sensors.size())));
    first_true_plane_.emplace_back();
  }
  void add_labels();
  std::vector<double> labels_of(const sense::LidarTruth& truth) const;
  std::uint64_t add_true_planes(std::vector<log::TruePlane> planes);
  void add_reading(const sense::PointSensorSpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;
  void add_reading(const sense::PlaneSensorSpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;

  void add_reading(const sense::BumpSensorSpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;
  void add_reading(const sim::EncoderSpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;
  void add_reading(const sense::GnssSpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;
  void add_reading(const sense::CompassSpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;
  void add_reading(const sense::SonarSpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;
  void add_reading(const sense::InfraredSpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;
  void add_reading(const sense::LidarSpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;
  void add_reading(const sense::ImuSensorSpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;
  void add_reading(const sense::WheelOdometrySpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;
  void add_reading(const sense::MouseOdometrySpec& spec, const sim::Reading& reading, SourceFrame& frame,
                   host::FrameBuilder& builder) const;

  const sim::Simulator& simulator_;
  std::optional<sim::DrivenRobot> robot_;         ///< where a drive moves it
  DriveNotes notes_;                              ///< since they were taken
  std::vector<std::uint32_t> label_of_triangle_;  ///< where a lidar has labels
  /// By sensor: the number of its first one in true_planes(); none where it sees no planes.
  std::vector<std::optional<std::uint64_t>> first_true_plane_;
};

}  // namespace hallway::run
