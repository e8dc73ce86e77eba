// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/row_writer.hpp"

namespace hallway::log {

/// A pose at a time: the body in the world (or in a map), T_world_body.
struct StampedPose {
  double t_s = 0.0;
  std::array<double, 3> position_m{};
  std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};  ///< unit quaternion w, x, y, z
};

/// Reads a trajectory in the format of the TUM RGB-D benchmark: lines `t x y z qx qy qz qw` between spaces, comments from
/// `#`, times increasing. Quaternions must have unit length within 0.01 and are given as they stand. Throws
/// Error{kBadInput} with the line of the first thing that is wrong, also for a file that is cut off. O(length).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<StampedPose> parse_tum(std::string_view text, const std::string& file);

/// parse_tum() of a file. Throws Error{kIo} if it cannot be read.
std::vector<StampedPose> read_tum(const std::filesystem::path& path);

/// Adds a line. Throws Error{kInternal} for a number that is not finite.
void add_row(RowWriter& out, const StampedPose& pose);

/// The text that parse_tum() reads back to the same values. Throws Error{kInternal} for a number that is not finite.
std::string print_tum(std::span<const StampedPose> poses);

/// print_tum() to a file, atomically. Throws Error{kIo}.
void write_tum(const std::filesystem::path& path, std::span<const StampedPose> poses);

}  // namespace hallway::log
