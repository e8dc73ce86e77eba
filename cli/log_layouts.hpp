// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "command_line.hpp"
#include "log/byte_io.hpp"
#include "log_input.hpp"

namespace hallway::cli {

/// As what a log is written.
enum class Layout { kMcap, kReplay, kTables, kKitti, kPcdImu, kEuroc, kTum };

/// What was chosen; what was not said is empty.
struct LayoutChoice {
  std::string to{};
  std::string sensor{};
  std::string imu{};
  bool deskew = false;
};

/// Adds the options of LayoutChoice.
void add_layout_options(Command& command, LayoutChoice& choice);

/// The layout that is meant: where it was not said, by the end of the output's name. Throws Error{kUsage} for options that do not belong to it, and for an
/// output of another kind.
Layout chosen_layout(const LayoutChoice& choice, const std::filesystem::path& out);

/// Writes a log to an empty folder in the layout of KITTI odometry, of a PCD+IMU folder or of EuRoC. Prints warnings, and keeps them in those of the log. Throws
/// Error{kUsage} for a sensor that there is not, or where one of several is to be chosen; Error{kBadInput} where the log has not what the layout needs;
/// Error{kIo}.
void write_layout(OpenedLog& opened, Layout layout, const LayoutChoice& choice,
                  const std::filesystem::path& folder, bool quiet);

/// Writes the true poses as a trajectory: of the body at each frame or, with a sensor, of this at the end of each of its readings. Throws likewise.
void write_true_trajectory(OpenedLog& opened, const LayoutChoice& choice, log::ByteOutput& output,
                           bool quiet);

}  // namespace hallway::cli
