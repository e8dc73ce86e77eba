// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <variant>

namespace hallway {

/// Why a TOML text is malformed, and in which line.
struct TomlProblem {
  std::string cause;
  int line = 0;
};

/// The same document in ASCII, line by line: what strings hold beyond ASCII is written as escapes, in comments as question marks; a byte order mark goes.
/// Elsewhere TOML has no letters beyond ASCII, and texts are UTF-8: what breaks these rules is the problem.
///
/// toml++ (3.3 and 3.4) is not defined for letters such as U+00E9 wherever it looks for blanks: between values, and after a backslash that ends a line of a
/// string, so even in well-formed texts. It never gets to see one. O(size).
std::variant<std::string, TomlProblem> ascii_toml(std::string_view text);

}  // namespace hallway
