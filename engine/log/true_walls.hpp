// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/landmark_id.hpp"

namespace hallway::log {

/// A true wall.
struct TrueWall {
  LandmarkId id = 0;
  /// World, metres, in the order of hw_plane_t.corners: counter-clockwise as seen from its empty side.
  std::array<std::array<double, 3>, 4> corners_m{};
  /// The convex outline of one with more than four corners, in the same sense; `corners_m` are then those of a rectangle around it. Else empty.
  std::vector<std::array<double, 3>> hull_m{};
};

/// Reads true walls from CSV: columns `wall_id,x0,y0,z0,…,x3,y3,z3` and perhaps `hull` in any order, each id once. Throws Error{kBadInput} with the line of
/// the first thing that is wrong, also for a file that is cut off. The walls keep the file's order. O(n log n).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<TrueWall> parse_true_walls(std::string_view text, const std::string& file);

/// parse_true_walls() of a file. Throws Error{kIo} if it cannot be read.
std::vector<TrueWall> read_true_walls(const std::filesystem::path& path);

/// The text that parse_true_walls() reads back to the same values. Throws Error{kInternal} for a number that is not finite.
std::string print_true_walls(std::span<const TrueWall> walls);

/// print_true_walls() to a file, atomically. Throws Error{kIo}.
void write_true_walls(const std::filesystem::path& path, std::span<const TrueWall> walls);

}  // namespace hallway::log
