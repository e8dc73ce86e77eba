// SPDX-License-Identifier: MIT
#include "base/toml_text.hpp"

namespace hallway {

std::string toml_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

}  // namespace hallway
