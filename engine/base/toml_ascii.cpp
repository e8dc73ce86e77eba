// SPDX-License-Identifier: MIT
#include "base/toml_ascii.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/toml_pieces.hpp"
#include "base/utf8.hpp"

namespace hallway {
namespace {

bool is_ascii(char c) {
  return static_cast<unsigned char>(c) < 0x80;
}

bool is_ascii(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return is_ascii(c); });
}

int lines_before(std::string_view text, std::size_t at) {
  return static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

std::optional<TomlProblem> broken_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const Utf8Code code = first_utf8_code(text.substr(at));
    if (code.length == 0) return TomlProblem{"the text is not UTF-8", 1 + lines_before(text, at)};
    at += code.length;
  }
  return std::nullopt;
}

/// A string's inside with escapes for all that is not ASCII; a literal one becomes a basic one.
void append_inside(std::string& out, std::string_view inside, bool literal) {
  while (!inside.empty()) {
    const Utf8Code code = first_utf8_code(inside);
    if (code.length > 1) {
      out += fmt::format("\\U{:08X}", static_cast<std::uint32_t>(code.value));
    } else {
      if (literal && (inside.front() == '\\' || inside.front() == '"')) out += '\\';
      out += inside.front();
    }
    inside.remove_prefix(code.length);
  }
}

void append_string(std::string& out, const TomlPiece& piece) {
  const std::size_t closing = piece.ended ? piece.marks : 0;
  const std::string marks(piece.marks, '"');
  out += marks;
  append_inside(out, piece.text.substr(piece.marks, piece.text.size() - piece.marks - closing),
                piece.kind == TomlPiece::Kind::kLiteralString);
  if (piece.ended) out += marks;
}

void append_comment(std::string& out, std::string_view comment) {
  std::ranges::transform(comment, std::back_inserter(out), [](char c) { return is_ascii(c) ? c : '?'; });
}

}  // namespace

std::variant<std::string, TomlProblem> ascii_toml(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (is_ascii(text)) return std::string(text);
  if (auto problem = broken_utf8(text)) return *problem;
  std::string out;
  out.reserve(text.size() + text.size() / 4);
  TomlPieces pieces(text);
  while (const auto piece = pieces.next()) {
    if (is_ascii(piece->text)) {
      out += piece->text;
    } else if (piece->kind == TomlPiece::Kind::kComment) {
      append_comment(out, piece->text);
    } else if (piece->kind == TomlPiece::Kind::kPlain) {
      const auto at =
          std::find_if_not(piece->text.begin(), piece->text.end(), [](char c) { return is_ascii(c); });
      return TomlProblem{
          "a letter that is not ASCII stands outside of strings and comments",
          piece->line + lines_before(piece->text, static_cast<std::size_t>(at - piece->text.begin()))};
    } else {
      append_string(out, *piece);
    }
  }
  return out;
}

}  // namespace hallway
