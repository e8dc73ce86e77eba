// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace hallway {

/// The first line, 1-based, that holds a key of more than `max_parts` dotted parts (`a.b.c` has three), or 0. Strings and
/// comments are skipped. The parser behind parse_toml() makes a table of every part and takes them apart recursively, so
/// that a key of a million parts would overflow the stack. O(size).
int line_of_deep_key(std::string_view toml, std::size_t max_parts);

}  // namespace hallway
