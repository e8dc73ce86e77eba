// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace hallway {

/// A stretch of a TOML text that is all of one kind. A string has its quotation marks with it; one that does not end goes to the end of its line, or, if it
/// may have many lines, of the text.
struct TomlPiece {
  enum class Kind { kPlain, kComment, kBasicString, kLiteralString };
  Kind kind = Kind::kPlain;
  std::string_view text;
  int line = 1;           ///< of its first byte, 1-based
  std::size_t marks = 0;  ///< quotation marks at either end: 1, or 3 for many lines
  bool ended = true;      ///< false for a string without its closing marks
};

/// Takes a TOML text apart just far enough to tell what is a string and what is a comment. The pieces in order are the text. O(size) in all.
class TomlPieces {
 public:
  explicit TomlPieces(std::string_view text) : text_(text) {}
  /// The next piece, never empty; nothing at the end.
  std::optional<TomlPiece> next();

 private:
  std::string_view rest() const { return text_.substr(at_); }
  void measure_string(TomlPiece& piece) const;

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

/// The first line, 1-based, that holds a key of more than `max_parts` dotted parts (`a.b.c` has three), or 0. Strings and
/// comments are skipped. The parser behind parse_toml() makes a table of every part and takes them apart recursively, so
/// that a key of a million parts would overflow the stack. O(size).
int line_of_deep_key(std::string_view toml, std::size_t max_parts);

}  // namespace hallway
