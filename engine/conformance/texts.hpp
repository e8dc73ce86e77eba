// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>

#include "base/text.hpp"
#include "conformance/test.hpp"

namespace hallway::conformance {

/// Throws Failed, naming `what`, where a text of the plugin is null, or no UTF-8 for people: control characters but line ends and tabs have no place
/// in it.
inline void demand_text(const char* text, const std::string& what) {
  demand(text != nullptr, what + " is null");
  std::string plain = text;
  std::ranges::replace_if(
      plain, [](char c) { return c == '\n' || c == '\t'; }, ' ');
  demand(printable(plain, 2 * plain.size() + 4) == plain,
         what + " is not UTF-8 without control characters: " + printable(text));
}

}  // namespace hallway::conformance
