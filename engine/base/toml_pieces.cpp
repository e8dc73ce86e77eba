// SPDX-License-Identifier: MIT
#include "base/toml_pieces.hpp"

#include <algorithm>

namespace hallway {

std::optional<TomlPiece> TomlPieces::next() {
  if (at_ == text_.size()) return std::nullopt;
  TomlPiece piece{.text = rest(), .line = line_};
  const char first = piece.text.front();
  if (first == '"' || first == '\'') {
    measure_string(piece);
  } else if (first == '#') {
    piece.kind = TomlPiece::Kind::kComment;
    piece.text = piece.text.substr(0, piece.text.find('\n'));
  } else {
    piece.text = piece.text.substr(0, piece.text.find_first_of("\"'#"));
  }
  at_ += piece.text.size();
  line_ += static_cast<int>(std::ranges::count(piece.text, '\n'));
  return piece;
}

void TomlPieces::measure_string(TomlPiece& piece) const {
  const std::string_view text = rest();
  const char mark = text.front();
  const bool basic = mark == '"';
  piece.kind = basic ? TomlPiece::Kind::kBasicString : TomlPiece::Kind::kLiteralString;
  const std::string_view three = basic ? "\"\"\"" : "'''";
  piece.marks = text.starts_with(three) ? 3 : 1;
  const std::string_view marks = three.substr(0, piece.marks);
  piece.ended = false;
  std::size_t end = piece.marks;
  while (end < text.size() && !piece.ended) {
    if (text[end] == '\n' && piece.marks == 1) break;  // the parser will say that the string does not end
    if (basic && text[end] == '\\' && text.substr(end + 1, 1) != "\n") {
      end += 2;
    } else if (text.substr(end, piece.marks) == marks) {
      end += piece.marks;
      piece.ended = true;
    } else {
      ++end;
    }
  }
  // A string of many lines may end in quotation marks of its own: up to two before the closing three.
  for (int i = 0; i < 2 && piece.ended && piece.marks == 3 && text.substr(end, 1) == three.substr(0, 1); ++i)
    ++end;
  piece.text = text.substr(0, std::min(end, text.size()));
}

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
