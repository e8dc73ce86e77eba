// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace hallway {

struct Utf8Code {
  std::size_t length = 0;  ///< bytes, 0 where no valid sequence starts
  char32_t value = 0;
};

/// The code point at the start of `text`. None is valid that is overlong, a surrogate, above U+10FFFF or cut off.
Utf8Code first_utf8_code(std::string_view text);

}  // namespace hallway
