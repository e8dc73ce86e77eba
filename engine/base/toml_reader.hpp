// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/toml_node.hpp"

namespace hallway {

/// Reads a TOML 1.0 text. Throws Error{kBadInput} with file, line and cause; nesting beyond a few dozen levels, as values or
/// as dotted keys, is refused.
/// @param file  name of the file for messages
TomlTable parse_toml(std::string_view text, const std::string& file);

/// The one value that `text` is in TOML; empty if it is none. Its line is 0.
std::optional<TomlNode> parse_toml_value(std::string_view text);

/// The value of a setting of the command line: a TOML value; what is none is taken as text. Its line is 0.
TomlNode toml_value_or_text(const std::string& text);

}  // namespace hallway
