// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::log {

/// Where a submap lies in a plugin's map.
struct SubmapPose {
  std::uint64_t id = 0;
  std::array<double, 3> position_m{};                     ///< map frame
  std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};  ///< unit quaternion w, x, y, z

  friend bool operator==(const SubmapPose&, const SubmapPose&) = default;
};

/// Reads the poses of submaps from CSV: columns `submap_id,x,y,z,qw,qx,qy,qz` in any order. Throws Error{kBadInput} with the line of the first
/// thing that is wrong, also for a file that is cut off. O(length).
///
/// @param text  the file's content
/// @param file  its name, for messages
std::vector<SubmapPose> parse_submap_poses(std::string_view text, const std::string& file);

/// parse_submap_poses() of a file. Throws Error{kIo} if it cannot be read.
std::vector<SubmapPose> read_submap_poses(const std::filesystem::path& path);

/// The text that parse_submap_poses() reads back to the same values. Throws Error{kInternal} for a number that is not finite.
std::string print_submap_poses(std::span<const SubmapPose> poses);

/// print_submap_poses() to a file, atomically. Throws Error{kIo}.
void write_submap_poses(const std::filesystem::path& path, std::span<const SubmapPose> poses);

}  // namespace hallway::log
