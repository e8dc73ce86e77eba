// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "log/poses.hpp"
#include "log/tum.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// A pose at a time, as the tables have it.
log::StampedPose stamped_pose(std::int64_t t_ns, const Pose& pose);

/// What is true of the frames of a run, as files of its folder.
class TruthTables {
 public:
  /// Frames in their order.
  void add(std::uint32_t iteration, const SourceFrame& frame);
  /// Writes truth.tum, truth_poses.csv, truth_landmarks.csv and true_walls.csv, as far as the truth is known. Throws Error{kIo}.
  void write(const std::filesystem::path& folder, const Source& source) const;

 private:
  std::vector<log::IterationPose> poses_;
  std::vector<log::StampedPose> trajectory_;
};

}  // namespace hallway::run
