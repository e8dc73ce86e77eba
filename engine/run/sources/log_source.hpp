// SPDX-License-Identifier: MIT
#pragma once

#include "log/observations.hpp"
#include "log/plane_observations.hpp"
#include "log/poses.hpp"
#include "run/sources/source.hpp"

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
  LogSource(log::ObservationLog observations, LogTruth truth, const host::SensorInfo& sensor,
            std::int64_t period_ns, std::uint32_t steps);
  /// Of a sensor that gives planes. Throws Error{kBadInput} naming the iteration of planes that are not as <hallway/planes.h> says.
  LogSource(log::PlaneObservationLog planes, LogTruth truth, const host::SensorInfo& sensor,
            std::int64_t period_ns, std::uint32_t steps);

  std::uint32_t iterations() const override { return iterations_; }

 private:
  void fill(std::uint32_t iteration, SourceFrame& frame) override;
  void add_points(host::FrameBuilder& builder, std::uint32_t iteration, SourceFrame& frame) const;
  void add_planes(host::FrameBuilder& builder, std::uint32_t iteration, SourceFrame& frame) const;
  LogSource(std::uint32_t kind, bool has_identities, LogTruth truth, const host::SensorInfo& sensor,
            std::int64_t period_ns);
  void count_iterations(std::uint32_t seen, std::uint32_t steps);
  void check_planes();

  log::ObservationLog observations_;  ///< of a sensor that gives points
  log::PlaneObservationLog planes_;   ///< of one that gives planes
  std::optional<std::vector<log::IterationPose>> true_poses_;
  std::int64_t period_ns_;
  std::uint32_t iterations_ = 0;
};

}  // namespace hallway::run
