// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "import/recording.hpp"

namespace hallway::import {

struct CloudOptions {
  std::filesystem::path
      times{};  ///< list of frames (frame_list.hpp); empty: `timestamps.txt` of the folder, if it is there
  std::optional<std::int64_t> period_ns{};  ///< from frame to frame where there is no list; 0.1 s if not said
  std::uint32_t stride = 1;                 ///< each n-th point is taken
};

/// A folder of point clouds as a recording; or one such file, as a recording of one frame. Where there is a list of times, it says which files are
/// the frames. Else these are all files of the folder that end in .ply or .pcd, in the order of the last number in each name (digits, or
/// digits, a point and digits), and their times are those of the period. Points are taken as they stand. Files are read when they are asked for.
/// Throws Error{kBadInput, kIo} naming what is wrong: no such files, a name without a number, the same number twice.
std::unique_ptr<Recording> open_clouds(const std::filesystem::path& path, const CloudOptions& options);

/// Whether a file is named like a point cloud that is read here.
bool is_cloud_file(const std::filesystem::path& path);

}  // namespace hallway::import
