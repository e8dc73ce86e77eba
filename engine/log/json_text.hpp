// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace hallway::log {

/// Refuses JSON from outside that would take far more memory than its text when parsed: more than 32 MiB, or brackets nested
/// deeper than 16. Whether it is JSON at all is the parser's to say. Throws Error{kBadInput}. O(length).
void check_json_size(std::string_view text);

}  // namespace hallway::log
