// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::import {

/// A file of a frame and its time.
struct FrameFile {
  std::int64_t t_ns = 0;
  std::filesystem::path path;
};

/// Reads which files are the frames of a recording, and of which times: lines `SECONDS FILE`, or `SECONDS FILE SECONDS FILE` of which the one with
/// "depth" in its name is meant; comments from `#`. Names are seen from `folder`, which they may not leave. Times do not decrease. Throws
/// Error{kBadInput} with the line of the first thing that is wrong, also for a file that is cut off, and for a list without any.
///
/// @param text    the list's content
/// @param file    its name, for messages
std::vector<FrameFile> parse_frame_list(std::string_view text, const std::string& file,
                                        const std::filesystem::path& folder);

/// parse_frame_list() of a file. Throws Error{kIo} if it cannot be read.
std::vector<FrameFile> read_frame_list(const std::filesystem::path& list,
                                       const std::filesystem::path& folder);

}  // namespace hallway::import
