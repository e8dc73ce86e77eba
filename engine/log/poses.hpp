// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/row_writer.hpp"

namespace hallway::log {

/// A pose at an iteration: the body in the world (or in a map), T_world_body.
struct IterationPose {
  std::uint32_t iteration = 0;
  std::array<double, 3> position_m{};
  std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};  ///< unit quaternion w, x, y, z
  bool orientation_known = true;  ///< false: only the position is meant, e.g. a satellite fix
};

/// Reads poses from CSV: columns `iteration,x,y,z,qw,qx,qy,qz` in any order, iterations increasing, with gaps where no pose
/// is known. Without the columns qw,qx,qy,qz only positions are known. Quaternions must have unit length within 0.01 and are
/// given as they stand, not normalised. Throws Error{kBadInput} with the line of the first thing that is wrong, also for a
/// file that is cut off. O(length).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<IterationPose> parse_poses(std::string_view text, const std::string& file);

/// parse_poses() of a file. Throws Error{kIo} if it cannot be read.
std::vector<IterationPose> read_poses(const std::filesystem::path& path);

/// The first line of the table, with or without orientations.
std::string_view pose_columns(bool orientations);
/// Adds a row. Throws Error{kInternal} for a number that is not finite.
void add_row(RowWriter& out, const IterationPose& pose, bool orientations);

/// The text that parse_poses() reads back to the same values, without orientations unless the first pose has one. Throws
/// Error{kInternal} for a number that is not finite.
std::string print_poses(std::span<const IterationPose> poses);

/// print_poses() to a file, atomically. Throws Error{kIo}.
void write_poses(const std::filesystem::path& path, std::span<const IterationPose> poses);

}  // namespace hallway::log
