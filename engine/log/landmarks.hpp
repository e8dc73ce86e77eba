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

/// A true landmark.
struct Landmark {
  LandmarkId id = 0;
  std::array<double, 3> position_m{};  ///< world; of one that moves: where it is at time 0
  bool moving = false;                 ///< does not stand still
};

/// Reads true landmarks from CSV: columns `landmark_id,x,y,z` and, where any moves, `moving` (0 or
/// 1), in any order, each id once. Throws Error{kBadInput} with the
/// line of the first thing that is wrong, also for a file that is cut off. The landmarks keep the file's order.
/// O(n log n).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<Landmark> parse_landmarks(std::string_view text, const std::string& file);

/// parse_landmarks() of a file. Throws Error{kIo} if it cannot be read.
std::vector<Landmark> read_landmarks(const std::filesystem::path& path);

/// The text that parse_landmarks() reads back to the same values. Throws Error{kInternal} for a number that is not finite.
std::string print_landmarks(std::span<const Landmark> landmarks);

/// print_landmarks() to a file, atomically. Throws Error{kIo}.
void write_landmarks(const std::filesystem::path& path, std::span<const Landmark> landmarks);

}  // namespace hallway::log
