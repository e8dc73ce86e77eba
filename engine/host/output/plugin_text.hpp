// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

#include "base/utf8.hpp"
#include "host/samples/strided.hpp"

namespace hallway::host {

/// A copy of a text that is a part of an output. Throws Malformed where it is null, longer or no UTF-8. O(length).
/// @param most_bytes  without the terminating 0
/// @param what        names it in messages
inline std::string copy_plugin_text(const char* text, std::size_t most_bytes, const char* what) {
  if (text == nullptr) throw Malformed{fmt::format("a {} that is null", what)};
  const std::size_t bytes = strnlen(text, most_bytes + 1);
  if (bytes > most_bytes) throw Malformed{fmt::format("a {} of more than {} bytes", what, most_bytes)};
  for (std::string_view rest(text, bytes); !rest.empty();) {
    const std::size_t length = first_utf8_code(rest).length;
    if (length == 0) throw Malformed{fmt::format("a {} that is no UTF-8", what)};
    rest.remove_prefix(length);
  }
  return {text, bytes};
}

}  // namespace hallway::host
