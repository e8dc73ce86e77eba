// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/map_landmarks.hpp"

namespace hallway::log {

/// A corner of a mapped plane's outline, and the edge from it to the next one.
struct OutlineCorner {
  std::array<double, 3> position_m{};  ///< map frame
  bool edge_certain = false;           ///< the plane truly ends there; else it was seen up to there

  friend bool operator==(const OutlineCorner&, const OutlineCorner&) = default;
};

/// A plane of a plugin's map.
struct PlaneLandmark {
  LandmarkId id = 0;
  std::uint64_t observations = 0;  ///< how many observations it rests on
  LandmarkStatus status = LandmarkStatus::kMapped;
  std::array<double, 3> normal{};  ///< unit, map frame, towards the side that it was seen from
  double offset_m = 0.0;           ///< normal . x on the plane
  /// Three corners or more, counter-clockwise seen from where the normal points. Of an upright wall: left and right at the bottom, right and
  /// left at the top.
  std::vector<OutlineCorner> outline{};

  friend bool operator==(const PlaneLandmark&, const PlaneLandmark&) = default;
};

/// Reads a plugin's planes from CSV: columns `plane_id,observations,status,nx,ny,nz,offset_m,corner,x,y,z,edge_certain` in any order, a row for
/// each corner, those of a plane one after the other and counted from 0. Throws Error{kBadInput} with the line of the first thing that is wrong,
/// also for a file that is cut off. O(n log n).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<PlaneLandmark> parse_plane_landmarks(std::string_view text, const std::string& file);

/// parse_plane_landmarks() of a file. Throws Error{kIo} if it cannot be read.
std::vector<PlaneLandmark> read_plane_landmarks(const std::filesystem::path& path);

/// The text that parse_plane_landmarks() reads back to the same values. Throws Error{kInternal} for a number that is not finite.
std::string print_plane_landmarks(std::span<const PlaneLandmark> planes);

/// print_plane_landmarks() to a file, atomically. Throws Error{kIo}.
void write_plane_landmarks(const std::filesystem::path& path, std::span<const PlaneLandmark> planes);

}  // namespace hallway::log
