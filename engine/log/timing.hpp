// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/row_writer.hpp"

namespace hallway::log {

/// What the plugins of an iteration took.
struct IterationTime {
  std::uint32_t iteration = 0;
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  ///< of the calling thread
};

/// Reads times from CSV: columns `iteration,wall_ms,cpu_ms` in any order, iterations increasing, times not negative. Throws
/// Error{kBadInput} with the line of the first thing that is wrong, also for a file that is cut off. O(length).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<IterationTime> parse_timing(std::string_view text, const std::string& file);

/// parse_timing() of a file. Throws Error{kIo} if it cannot be read.
std::vector<IterationTime> read_timing(const std::filesystem::path& path);

/// The first line of the table.
inline constexpr std::string_view kTimingColumns = "iteration,wall_ms,cpu_ms";

/// Adds a row. Throws Error{kInternal} for a number that is not finite.
void add_row(RowWriter& out, const IterationTime& time);

/// The text that parse_timing() reads back to the same values. Throws Error{kInternal} for a number that is not finite.
std::string print_timing(std::span<const IterationTime> times);

}  // namespace hallway::log
