// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "import/scan_cloud.hpp"
#include "run/sources/source.hpp"

namespace hallway::cli {

/// What is true of a reading.
struct TrueReading {
  std::int64_t begin_ns = 0;           ///< true time, where the log has it; else the sensor's
  std::int64_t end_ns = 0;             ///< likewise
  std::optional<Pose> T_world_body{};  ///< at end_ns, where the log has the pose of that time
};

/// What a frame says is true of its sample `k`.
TrueReading true_reading(const run::SourceFrame& frame, std::uint32_t k);

/// What the log says is true at the time of a frame; nothing where it has no orientation.
std::optional<Pose> true_pose(const run::SourceFrame& frame);

/// Reads all frames of a source in their order. Throws Error{kInterrupted} after Ctrl-C.
/// @param quiet  shows no progress
void each_frame(run::Source& source, bool quiet,
                const std::function<void(std::uint32_t iteration, const run::SourceFrame& frame)>& take);

/// The truth of a log as a whole.
struct LogMotion {
  import::TrueMotion motion;         ///< all true poses, of frames and of readings
  std::vector<std::int64_t> end_ns;  ///< true ends of the readings of one sensor
};

/// Reads a source once for its truth. @param sensor  id
LogMotion read_motion(run::Source& source, std::uint32_t sensor, bool quiet);

}  // namespace hallway::cli
