// SPDX-License-Identifier: MIT
#include "base/utf8.hpp"

namespace hallway {

Utf8Code first_utf8_code(std::string_view text) {
  if (text.empty()) return {};
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  std::size_t length = 0;
  char32_t code = 0;
  if (first < 0x80) return {1, first};
  if (first >= 0xC2 && first <= 0xDF) length = 2, code = first & 0x1Fu;
  if (first >= 0xE0 && first <= 0xEF) length = 3, code = first & 0x0Fu;
  if (first >= 0xF0 && first <= 0xF4) length = 4, code = first & 0x07u;
  if (length == 0 || text.size() < length) return {};
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    code = (code << 6) | (byte(i) & 0x3Fu);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (overlong || surrogate || code > 0x10FFFF) return {};
  return {length, code};
}

}  // namespace hallway
