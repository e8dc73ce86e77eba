// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>

namespace hallway::host {

/// How a plugin is kept in a process of its own.
struct Isolation {
  std::chrono::milliseconds call_time{60'000};  ///< what one call may take, by the wall clock
  /// What a report may take: ten calls, but a minute at most, or one call where that is more. It optimises the whole map.
  std::chrono::milliseconds report_time() const {
    return std::max(call_time, std::min(10 * call_time, std::chrono::milliseconds(60'000)));
  }
  std::uint64_t memory_bytes = std::uint64_t{4} << 30;  ///< what its process may hold
  std::uint32_t threads = 1024;                         ///< that its process may have
  std::uint64_t file_bytes = std::uint64_t{1} << 30;    ///< largest file that it may write
  std::filesystem::path
      temporary{};  ///< folder in which each plugin gets its scratch folder, which is removed at its end; empty: none
};

}  // namespace hallway::host
