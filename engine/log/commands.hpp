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

/// How a plugin wanted the robot to drive, from a frame on.
struct IterationCommand {
  std::uint32_t iteration = 0;
  double linear_m_s = 0.0;     ///< along the body's x axis, forward positive
  double angular_rad_s = 0.0;  ///< about the body's z axis, to the left positive
};

/// The first line of the table.
inline constexpr std::string_view kCommandColumns = "iteration,linear_m_s,angular_rad_s";

/// Reads commands from CSV: columns `iteration,linear_m_s,angular_rad_s` in any order, iterations increasing. Throws
/// Error{kBadInput} with the line of the first thing that is wrong, also for a file that is cut off. O(length).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<IterationCommand> parse_commands(std::string_view text, const std::string& file);

/// parse_commands() of a file. Throws Error{kIo} if it cannot be read.
std::vector<IterationCommand> read_commands(const std::filesystem::path& path);

/// Adds a row. Throws Error{kInternal} for a number that is not finite.
void add_row(RowWriter& out, const IterationCommand& command);

/// The text that parse_commands() reads back to the same values. Throws Error{kInternal} for a number that is not finite.
std::string print_commands(std::span<const IterationCommand> commands);

}  // namespace hallway::log
