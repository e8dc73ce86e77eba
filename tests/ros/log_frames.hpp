// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

// Kept apart from what includes headers of ROS 1: those are C++17, ours of the log are C++20.

namespace hallway::test {

/// A frame of a log with one reading of points.
struct LogFrame {
  std::uint64_t sequence = 0;
  std::int64_t t_ns = 0;
  std::vector<hw_point3_t> points{};
  std::string bytes{};  ///< as they stand in the log
};

/// The frames of a run log. Throws std::runtime_error if it is damaged or a frame has not one reading.
std::vector<LogFrame> read_log_frames(const std::filesystem::path& file);

/// Writes a run log of one frame each millisecond with these points.
void write_log(const std::filesystem::path& file, const std::vector<std::vector<hw_point3_t>>& frames);

}  // namespace hallway::test
