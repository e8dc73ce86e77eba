// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "host/output/outputs.hpp"
#include "host/stage.hpp"
#include "log/command_file.hpp"
#include "log/row_file.hpp"
#include "log/topology.hpp"
#include "log/tum.hpp"

namespace hallway::record {

/// A pose of the ABI as a row of trajectory.tum.
log::StampedPose stamped_pose(std::int64_t t_ns, const hw_pose_t& pose);

/// A frame that was answered.
struct AnsweredFrame {
  std::uint32_t iteration = 0;
  std::int64_t t_ns = 0;
  std::uint32_t n_samples = 0;  ///< without those that plugins add
};

/// Writes what a pipeline answers, frame by frame, into the tables of a run folder: trajectory.tum, timing.csv and, from the first covariance,
/// the first command and the first planes on, pose_covariances.csv, commands.csv and planes.csv; from the first pose of another time than its frame's on, pose_times.csv. Memory does not grow with the run. All functions throw Error{kIo}.
class AnswerTables {
 public:
  explicit AnswerTables(const std::filesystem::path& folder);

  /// The answer to a frame; iterations increase.
  void add(const AnsweredFrame& frame, const host::Outputs& outputs, const host::CallTime& time);
  /// The topology that was put last; nothing if none was.
  const std::optional<log::Topology>& topology() const { return topology_; }
  /// No more answers come.
  void close();

 private:
  void add_pose(std::uint32_t iteration, std::int64_t t_ns, const host::PoseOutput& pose);
  void add_planes(std::uint32_t iteration, const host::PlaneList& list);

  std::filesystem::path folder_;
  log::RowFile trajectory_;
  log::RowFile times_;
  std::optional<log::RowFile> covariances_;
  std::optional<log::RowFile> pose_times_;
  std::optional<log::CommandFile> commands_;
  std::optional<log::RowFile> planes_;
  std::optional<log::Topology> topology_;
};

/// Nanoseconds as the milliseconds of timing.csv.
inline double milliseconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-6;
}

}  // namespace hallway::record
