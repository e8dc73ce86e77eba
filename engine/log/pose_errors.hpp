// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace hallway::log {

/// How far an estimated pose is from the true one.
struct PoseErrorRow {
  std::uint32_t iteration = 0;
  double position_m = 0.0;
  double heading_deg = 0.0;  ///< about the vertical, positive to the left
};

/// A CSV table with the columns `iteration,position_m,heading_deg`. Throws Error{kInternal} for a number that is not finite.
std::string print_pose_errors(std::span<const PoseErrorRow> rows);

/// print_pose_errors() to a file, atomically. Throws Error{kIo}.
void write_pose_errors(const std::filesystem::path& path, std::span<const PoseErrorRow> rows);

}  // namespace hallway::log
