// SPDX-License-Identifier: MIT
#include "base/toml_depth.hpp"

namespace hallway {
namespace {

/// Takes a TOML text apart just far enough to tell what is a string and what is a comment.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  int line_of_deep_key(std::size_t max_parts) {
    std::size_t parts = 1;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        skip_string(c);
        continue;
      }
      if (c == '#') {
        skip_comment();
        continue;
      }
      if (c == '\n') ++line_;
      if (c == '.' && ++parts > max_parts) return line_;
      if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) parts = 1;
      ++at_;
    }
    return 0;
  }

 private:
  void skip_comment() {
    const std::size_t end = text_.find('\n', at_);
    at_ = end == std::string_view::npos ? text_.size() : end;
  }

  void skip_string(char quote) {
    const std::string_view triple = quote == '"' ? "\"\"\"" : "'''";
    const bool many_lines = text_.substr(at_, 3) == triple;
    at_ += many_lines ? 3 : 1;
    while (at_ < text_.size()) {
      if (text_[at_] == '\n') {
        if (!many_lines) return;  // the parser will say that the string does not end
        ++line_;
      }
      if (quote == '"' && text_[at_] == '\\' && text_.substr(at_ + 1, 1) != "\n") {
        at_ += 2;
      } else if (many_lines ? text_.substr(at_, 3) == triple : text_[at_] == quote) {
        at_ += many_lines ? 3 : 1;
        if (many_lines) skip_extra_quotes(quote);
        return;
      } else {
        ++at_;
      }
    }
  }

  /// A string of many lines may end in quotation marks of its own: up to two before the closing three.
  void skip_extra_quotes(char quote) {
    for (int i = 0; i < 2 && text_.substr(at_, 1) == std::string_view(&quote, 1); ++i) ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

int line_of_deep_key(std::string_view toml, std::size_t max_parts) {
  return Scanner(toml).line_of_deep_key(max_parts);
}

}  // namespace hallway
