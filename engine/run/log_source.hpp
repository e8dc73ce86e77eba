// SPDX-License-Identifier: MIT
#pragma once

#include "log/poses.hpp"
#include "run/source.hpp"

namespace hallway::run {

/// What is known about a recorded log beside its observations.
struct LogTruth {
  std::optional<std::vector<log::IterationPose>> poses;  ///< T_world_body
  std::optional<std::vector<log::Landmark>> landmarks;   ///< world
  std::optional<std::vector<log::TruePlane>> planes;     ///< world
};

/// The frames of a recorded log.
class LogSource : public Source {
 public:
  /// @param period_ns  time from frame to frame
  /// @param steps      how many frames to give; 0 for all
  LogSource(log::ObservationLog observations, LogTruth truth, host::SensorInfo sensor, std::int64_t period_ns,
            std::uint32_t steps);
  /// Of a sensor that gives planes. Throws Error{kBadInput} naming the iteration of planes that are not as <hallway/planes.h> says.
  LogSource(log::PlaneObservationLog planes, LogTruth truth, host::SensorInfo sensor, std::int64_t period_ns,
            std::uint32_t steps);

  std::uint32_t iterations() const override { return iterations_; }
  void read(std::uint32_t iteration, SourceFrame& frame) override;
  const host::SensorInfo& sensor() const override { return sensor_; }
  bool has_identities() const override {
    return is_of_planes() ? planes_.has_identities() : observations_.has_identities();
  }
  bool has_tracks() const override { return observations_.has_tracks(); }
  const std::optional<std::vector<log::Landmark>>& true_landmarks() const override {
    return truth_.landmarks;
  }
  const std::optional<std::vector<log::TruePlane>>& true_planes() const override { return truth_.planes; }

 private:
  bool is_of_planes() const { return sensor_.kind == HW_SAMPLE_PLANES; }
  void count_iterations(std::uint32_t seen, std::uint32_t steps);
  void check_planes();

  log::ObservationLog observations_;  ///< of a sensor that gives points
  log::PlaneObservationLog planes_;   ///< of one that gives planes
  LogTruth truth_;
  host::SensorInfo sensor_;
  std::int64_t period_ns_;
  std::uint32_t iterations_;
};

}  // namespace hallway::run
