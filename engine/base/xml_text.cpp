// SPDX-License-Identifier: MIT
#include "base/xml_text.hpp"

#include <algorithm>

#include "base/utf8.hpp"

namespace hallway {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

/// Whether XML 1.0 allows a character. A carriage return alone would be read as a line feed.
bool is_allowed(char32_t code) {
  if (code < 0x20) return code == U'\n' || code == U'\t';
  return code != 0xFFFE && code != 0xFFFF;
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string safe;
  while (!text.empty()) {
    const Utf8Code code = first_utf8_code(text);
    const std::size_t length = std::max<std::size_t>(code.length, 1);
    if (code.value == U'&') {
      safe += "&amp;";
    } else if (code.value == U'<') {
      safe += "&lt;";
    } else if (code.value == U'>') {
      safe += "&gt;";
    } else if (code.value == U'"') {
      safe += "&quot;";
    } else {
      safe += code.length > 0 && is_allowed(code.value) ? text.substr(0, length) : kReplacement;
    }
    text.remove_prefix(length);
  }
  return safe;
}

}  // namespace hallway
