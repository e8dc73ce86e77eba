// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace hallway::import {

/// Kinds of recordings that are read here.
enum class Kind { kClouds, kTum, kVictoriaPark, kStereoTracks, kRangeBearing, kBag, kKitti, kEuroc, kPcdImu };

/// Whether it is one of several sensors, or of others than points: rig_recording.hpp opens it.
constexpr bool is_rig(Kind kind) {
  return kind >= Kind::kKitti;
}

/// "clouds", "tum", "victoria-park", "stereo-tracks", "range-bearing", "bag", "kitti", "euroc", "pcd-imu".
const char* kind_name(Kind kind);
/// The kind of that name, empty for another.
std::optional<Kind> kind_named(std::string_view name);

/// What a path holds. Of a file its first bytes tell (of a table its first line), else the end of its name; of a folder the files in it: `depth.txt` or `associations.txt` a TUM
/// folder, `scans.csv` with `observations.csv` Victoria Park, `mav0` or `imu0` EuRoC, `sequences` or `velodyne` with `times.txt` KITTI odometry, files that end
/// in .ply or .pcd clouds, .pcd with `imu.csv` a folder with an IMU. Empty for a log of our own, and for other files and
/// what is neither file nor folder. Opens only regular files. Throws Error{kBadInput} for a folder that holds none of all this, Error{kIo}.
std::optional<Kind> tell_kind(const std::filesystem::path& path);

}  // namespace hallway::import
