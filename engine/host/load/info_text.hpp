// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace hallway::host {

// What plugins and drivers say of themselves.

/// Of a text; what is longer is cut.
inline constexpr std::size_t kMaxInfoTextBytes = 1000;

/// Throws Error{kPluginLoad}: "describes itself badly: …".
[[noreturn]] void fail_info(const std::string& message);
/// A text that is safe to print. Throws Error{kPluginLoad} naming the member if it is null.
std::string read_info_text(const char* text, const char* member);
/// An id. Throws Error{kPluginLoad} if it is not one.
std::string read_info_id(const char* text);

}  // namespace hallway::host
