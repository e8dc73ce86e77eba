// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::map {

/// A cause without a place; the reader adds file, line and element.
struct SyntaxFault {
  int line;
  std::string message;
};

/// Cuts the text of a map file into what its grammar is made of. Comments are collected on the way until somebody takes
/// them. Functions throw SyntaxFault.
class Tokenizer {
 public:
  /// What a quoted text is decides how it may end, see quoted().
  enum class Quoted { kName, kValue };

  /// Refuses texts that hold a NUL or are UTF-16. The text must outlive this.
  explicit Tokenizer(std::string_view text);

  /// Skips blanks and comments; the next character, or 0 at the end of the text.
  char peek();
  /// Skips blanks and comments; takes `symbol` if it is next.
  bool accept(char symbol);
  /// Skips blanks and comments; takes `symbol` or throws.
  void expect(char symbol, std::string_view purpose);
  /// A finite decimal number.
  double number(std::string_view purpose);
  /// True if what follows blanks and comments can only be a number.
  bool number_follows();
  /// A text in quotation marks, decoded. A backslash before a quotation mark makes it part of the text, except that
  /// a value may end in a backslash: `\"` at the end of a line ends it, since Windows paths are written so.
  std::string quoted(Quoted kind, std::string_view purpose);
  /// A name of anything but blanks, or a quoted one.
  std::string material();
  /// Skips blanks and comments, and takes what is up to the next blank or symbol.
  void take_word();
  /// Takes a word and the braces that follow it with all that is between, as it stands in the text. Braces are those
  /// that stand between blanks; what is quoted or a comment does not count.
  std::string block();
  /// What stands next, for a message.
  std::string describe_next();

  std::vector<std::string> take_comments();
  int line() const { return line_; }

 private:
  void skip_whitespace();
  void skip_blanks();
  void read_comment(std::size_t marker_length);
  std::string_view bare_token();
  std::string_view blank_token();
  std::string_view raw_token();
  [[noreturn]] void fail(std::string message) const;

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::vector<std::string> comments_;
};

}  // namespace hallway::map
