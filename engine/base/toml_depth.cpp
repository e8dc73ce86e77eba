// SPDX-License-Identifier: MIT
#include "base/toml_depth.hpp"

#include "base/toml_pieces.hpp"

namespace hallway {

int line_of_deep_key(std::string_view toml, std::size_t max_parts) {
  TomlPieces pieces(toml);
  std::size_t parts = 1;
  while (const auto piece = pieces.next()) {
    if (piece->kind != TomlPiece::Kind::kPlain) continue;
    int line = piece->line;
    for (const char c : piece->text) {
      if (c == '\n') ++line;
      if (c == '.' && ++parts > max_parts) return line;
      if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) parts = 1;
    }
  }
  return 0;
}

}  // namespace hallway
