// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "log/row_writer.hpp"

namespace hallway::log {

/// The upper triangle, by rows, of the covariance of a pose's error: position x, y, z [m], then rotation vector x, y, z [rad],
/// both in the map's frame.
using PoseCovariance = std::array<double, 21>;

/// How sure a plugin was of the pose of an iteration.
struct IterationCovariance {
  std::uint32_t iteration = 0;
  PoseCovariance covariance{};
};

/// The first line of the table.
inline constexpr std::string_view kPoseCovarianceColumns =
    "iteration,xx,xy,xz,xa,xb,xc,yy,yz,ya,yb,yc,zz,za,zb,zc,aa,ab,ac,bb,bc,cc";

/// The upper triangle of a 6 x 6 matrix given by rows.
PoseCovariance upper_triangle(const std::array<double, 36>& matrix);

/// Reads covariances from CSV: the columns of kPoseCovarianceColumns in any order, iterations increasing, with gaps where none
/// was told. Throws Error{kBadInput} with the line of the first thing that is wrong, also for a file that is cut off.
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<IterationCovariance> parse_pose_covariances(std::string_view text, const std::string& file);

/// parse_pose_covariances() of a file. Throws Error{kIo} if it cannot be read.
std::vector<IterationCovariance> read_pose_covariances(const std::filesystem::path& path);

/// Adds a row. Throws Error{kInternal} for a number that is not finite.
void add_row(RowWriter& out, const IterationCovariance& row);

}  // namespace hallway::log
