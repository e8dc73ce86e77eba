// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "import/depth_camera.hpp"
#include "import/recording.hpp"

namespace hallway::import {

struct TumOptions {
  std::filesystem::path
      list{};  ///< list of frames (frame_list.hpp); empty: `depth.txt`, else `associations.txt` of the folder
  std::optional<Camera>
      camera{};  ///< the benchmark's default, Camera{}, for images of 640 x 480 pixels, if not said
  std::uint32_t stride = 1;                   ///< each n-th pixel of each n-th row is taken
  std::int64_t truth_within_ns = 20'000'000;  ///< how far from an image a true pose may lie (true_track.hpp)
};

/// A folder of the TUM RGB-D benchmark as a recording: the points of its depth images (PNG, grey, 16 bits, 5000 units in a metre), and the poses of
/// `groundtruth.txt`, if it is there. Files are read when they are asked for. Throws Error{kBadInput, kIo} naming file and line.
std::unique_ptr<Recording> open_tum(const std::filesystem::path& folder, const TumOptions& options);

}  // namespace hallway::import
