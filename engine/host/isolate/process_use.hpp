// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace hallway::host {

/// What a process holds at a moment.
struct ProcessUse {
  std::uint64_t memory_bytes = 0;  ///< resident
  std::uint64_t threads = 0;
};

/// Reads it from /proc; nothing where the process is no more.
std::optional<ProcessUse> read_process_use(pid_t pid);

}  // namespace hallway::host
