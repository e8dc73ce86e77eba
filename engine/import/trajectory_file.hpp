// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "log/tum.hpp"

namespace hallway::import {

/// How other programs write trajectories.
enum class TrajectoryFormat {
  kTum,    ///< lines `t x y z qx qy qz qw` (TUM RGB-D benchmark), seconds
  kKitti,  ///< lines of twelve numbers, the upper three rows of T_world_body by rows (KITTI odometry benchmark); without times
  kEuroc,  ///< CSV with a header: time in nanoseconds, x, y, z, qw, qx, qy, qz, and columns that are passed over (EuRoC MAV data)
};

/// "tum", "kitti", "euroc".
const char* name_of(TrajectoryFormat format);
/// The format of that name, if there is one.
std::optional<TrajectoryFormat> trajectory_format(std::string_view name);

/// A trajectory of another program.
struct ForeignTrajectory {
  TrajectoryFormat format{};
  std::vector<log::StampedPose>
      poses{};           ///< times increase; of KITTI they are the numbers of the lines, from 0
  bool cut_off = false;  ///< the last line has no line end
};

/// Reads a trajectory. Blank lines and comments (`#`) are passed over. Orientations are normalised: quaternions must have unit length within 0.01,
/// and matrices must be rotations within 0.01 (in every element of R R^T) and become the nearest rotation. Throws Error{kBadInput} with the line of the first thing
/// that is wrong. O(length).
///
/// @param text    the file's content
/// @param file    its name, for messages
/// @param format  empty: told from the first line that is no comment
ForeignTrajectory parse_trajectory(std::string_view text, const std::string& file,
                                   std::optional<TrajectoryFormat> format = std::nullopt);

/// parse_trajectory() of a file. Throws Error{kIo} if it cannot be read.
ForeignTrajectory read_trajectory(const std::filesystem::path& path,
                                  std::optional<TrajectoryFormat> format = std::nullopt);

/// Reads one time in seconds a line, increasing, as `times.txt` of KITTI has them. Throws Error{kBadInput}, Error{kIo}.
std::vector<double> read_times(const std::filesystem::path& path);

}  // namespace hallway::import
