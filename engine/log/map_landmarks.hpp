// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/landmark_id.hpp"

namespace hallway::log {

/// What a plugin holds a landmark to be; the numbers are those of the PLY file.
enum class LandmarkStatus : std::uint8_t {
  kTemporary = 0,  ///< not yet sure to exist
  kMapped = 1,     ///< part of the map
  kDynamic = 2,    ///< seen to move
};

/// The status's name in files: "temporary", "mapped", "dynamic".
std::string_view landmark_status_name(LandmarkStatus status);
/// The status of that name.
std::optional<LandmarkStatus> landmark_status(std::string_view name);

/// A landmark of a plugin's map.
struct MapLandmark {
  LandmarkId id = 0;
  std::array<double, 3> position_m{};  ///< map frame
  std::uint64_t observations = 0;      ///< how many observations it rests on
  LandmarkStatus status = LandmarkStatus::kMapped;
  /// Of the error of its position, map frame [m^2]: xx, xy, xz, yy, yz, zz. Nothing where it is not told.
  std::optional<std::array<double, 6>> covariance{};
};

/// Reads a plugin's map from CSV: columns `id,x,y,z,observations,status` in any order, each id once; the columns
/// `cov_xx,cov_xy,cov_xz,cov_yy,cov_yz,cov_zz` may be there too, with six empty fields where no covariance is told. Throws
/// Error{kBadInput} with the line of the first thing that is wrong, also for a file that is cut off. The landmarks keep the
/// file's order. O(n log n).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<MapLandmark> parse_map_landmarks(std::string_view text, const std::string& file);

/// parse_map_landmarks() of a file. Throws Error{kIo} if it cannot be read.
std::vector<MapLandmark> read_map_landmarks(const std::filesystem::path& path);

/// The text that parse_map_landmarks() reads back to the same values. Throws Error{kInternal} for a number that is not
/// finite.
std::string print_map_landmarks(std::span<const MapLandmark> landmarks);

/// print_map_landmarks() to a file, atomically. Throws Error{kIo}.
void write_map_landmarks(const std::filesystem::path& path, std::span<const MapLandmark> landmarks);

/// The same as an ASCII PLY point cloud: x, y, z, id, observations and the number of the status per vertex. Throws
/// Error{kInternal} for a number that is not finite. Ids and counts above 2^32 - 2 do not fit the format and stand as
/// 4294967295.
std::string print_landmarks_ply(std::span<const MapLandmark> landmarks);

/// print_landmarks_ply() to a file, atomically. Throws Error{kIo}.
void write_landmarks_ply(const std::filesystem::path& path, std::span<const MapLandmark> landmarks);

}  // namespace hallway::log
