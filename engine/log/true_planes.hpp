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

/// A plane of the world, or a convex part of one, as simulator and evaluator know it.
struct TruePlane {
  LandmarkId id = 0;
  /// World, metres, in the order of hw_plane_t.corners: counter-clockwise as seen from its empty side.
  std::array<std::array<double, 3>, 4> corners_m{};
  /// The convex outline of one with more than four corners, in the same sense; `corners_m` are then those of a rectangle around it. Else empty.
  std::vector<std::array<double, 3>> hull_m{};

  /// The hull, or else the corners.
  std::span<const std::array<double, 3>> outline() const {
    return hull_m.empty() ? std::span<const std::array<double, 3>>(corners_m) : hull_m;
  }
};

/// Reads true planes from CSV: columns `wall_id,x0,y0,z0,…,x3,y3,z3` and perhaps `hull` in any order, each id once. Throws Error{kBadInput} with the line of
/// the first thing that is wrong, also for a file that is cut off. The planes keep the file's order. O(n log n).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<TruePlane> parse_true_planes(std::string_view text, const std::string& file);

/// parse_true_planes() of a file. Throws Error{kIo} if it cannot be read.
std::vector<TruePlane> read_true_planes(const std::filesystem::path& path);

/// The text that parse_true_planes() reads back to the same values. Throws Error{kInternal} for a number that is not finite.
std::string print_true_planes(std::span<const TruePlane> planes);

/// print_true_planes() to a file, atomically. Throws Error{kIo}.
void write_true_planes(const std::filesystem::path& path, std::span<const TruePlane> planes);

}  // namespace hallway::log
