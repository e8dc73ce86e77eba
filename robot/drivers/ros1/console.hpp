// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/driver.hpp>

#include <cstdint>
#include <string>

namespace hallway::ros1 {

/// From here on what roscpp prints, and say(), go to the log of `host`; nothing goes to stdout and stderr.
void open_console(const sdk::Host& host);
/// From here on both are lost: the host may be gone.
void close_console();
/// Tells a person something. `level` is HW_LOG_…. May be called by any thread.
void say(std::uint32_t level, const std::string& message);

}  // namespace hallway::ros1
