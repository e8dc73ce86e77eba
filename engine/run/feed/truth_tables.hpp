// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <utility>

#include "log/row_file.hpp"
#include "log/tum.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// A pose at a time, as the tables have it.
log::StampedPose stamped_pose(std::int64_t t_ns, const Pose& pose);

/// Writes what is true of a run into its folder while it goes on: truth.tum and truth_poses.csv from the first known pose on. All functions throw
/// Error{kIo}.
class TruthTables {
 public:
  explicit TruthTables(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Frames in their order.
  void add(std::uint32_t iteration, const SourceFrame& frame);
  /// No more frames come. Writes truth_landmarks.csv and true_walls.csv, as far as the truth is known.
  void finish(const Source& source);

 private:
  std::filesystem::path folder_;
  std::optional<log::RowFile> trajectory_;
  std::optional<log::RowFile> poses_;
  bool orientations_ = true;  ///< whether truth_poses.csv has them: whether its first pose has
};

}  // namespace hallway::run
