// SPDX-License-Identifier: MIT
#include "map/tokenizer.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "map/reader.hpp"

namespace hallway::map {
namespace {

constexpr std::string_view kBlank = " \t\r\n\v\f";
constexpr std::string_view kBlankInLine = " \t\r\v\f";
constexpr std::string_view kSymbols = "()[]{}\"";

bool is_blank(char c) {
  return kBlank.find(c) != std::string_view::npos;
}

/// `// entity 3` and `// brush 7`, which editors write anew each time and which an edit makes wrong.
bool is_running_number(std::string_view comment) {
  for (const std::string_view word : {std::string_view("entity "), std::string_view("brush ")}) {
    if (comment.starts_with(word)) {
      const std::string_view number = comment.substr(word.size());
      return !number.empty() &&
             std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
    }
  }
  return false;
}

}  // namespace

Tokenizer::Tokenizer(std::string_view text) : text_(text) {
  if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF")) {
    fail("the file is UTF-16 text; save it as UTF-8");
  }
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  const std::size_t nul = text_.find('\0');
  if (nul != std::string_view::npos) {
    line_ +=
        static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(nul), '\n'));
    fail("a NUL byte: this is no UTF-8 text");
  }
}

void Tokenizer::fail(std::string message) const {
  throw SyntaxFault{line_, std::move(message)};
}

void Tokenizer::skip_whitespace() {
  for (; at_ < text_.size() && is_blank(text_[at_]); ++at_) {
    if (text_[at_] == '\n') ++line_;
  }
}

void Tokenizer::skip_blanks() {
  for (;;) {
    skip_whitespace();
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("//")) {
      read_comment(2);
    } else if (rest.starts_with(";")) {
      read_comment(1);
    } else {
      return;
    }
  }
}

void Tokenizer::read_comment(std::size_t marker_length) {
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string_view comment = text_.substr(at_ + marker_length, end - at_ - marker_length);
  if (comment.starts_with(" ")) comment.remove_prefix(1);
  const std::size_t last = comment.find_last_not_of(kBlankInLine);
  comment = comment.substr(0, last == std::string_view::npos ? 0 : last + 1);
  if (comment.size() > kMaxValueBytes) {
    fail("a comment of " + std::to_string(comment.size()) + " bytes; the limit is " +
         std::to_string(kMaxValueBytes));
  }
  if (!is_running_number(comment)) comments_.emplace_back(comment);
  at_ = end;
}

char Tokenizer::peek() {
  skip_blanks();
  return at_ < text_.size() ? text_[at_] : '\0';
}

bool Tokenizer::accept(char symbol) {
  if (peek() != symbol) return false;
  ++at_;
  return true;
}

void Tokenizer::expect(char symbol, std::string_view purpose) {
  if (accept(symbol)) return;
  fail("expected `" + std::string(1, symbol) + "` " + std::string(purpose) + ", found " + describe_next());
}

std::string_view Tokenizer::bare_token() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_]) && kSymbols.find(text_[at_]) == std::string_view::npos)
    ++at_;
  return text_.substr(begin, at_ - begin);
}

void Tokenizer::take_word() {
  skip_blanks();
  bare_token();
}

/// What stands before the next blank.
std::string_view Tokenizer::blank_token() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

double Tokenizer::number(std::string_view purpose) {
  const char next = peek();
  if (next == '\0' || kSymbols.find(next) != std::string_view::npos) {
    fail("expected a number for " + std::string(purpose) + ", found " + describe_next());
  }
  const std::string_view token = bare_token();
  const auto value = parse_double(token);
  if (!value) {
    fail("`" + printable(token, 60) + "` is no finite decimal number (" + std::string(purpose) + ")");
  }
  return *value;
}

bool Tokenizer::number_follows() {
  const char next = peek();
  return next != '\0' && kSymbols.find(next) == std::string_view::npos;
}

std::string Tokenizer::quoted(Quoted kind, std::string_view purpose) {
  expect('"', "for " + std::string(purpose));
  const std::size_t limit = kind == Quoted::kValue ? kMaxValueBytes : kMaxKeyBytes;
  std::string decoded;
  for (; at_ < text_.size() && text_[at_] != '\n'; ++at_) {
    const std::string_view rest = text_.substr(at_);
    if (rest[0] == '"') {
      ++at_;
      return decoded;
    }
    if (decoded.size() == limit)
      fail(std::string(purpose) + " is longer than " + std::to_string(limit) + " bytes");
    if (rest.starts_with("\\\"")) {
      const std::string_view after = rest.substr(2);
      const bool ends_line = after.empty() || after.starts_with("\n") || after.starts_with("\r\n");
      if (kind == Quoted::kName || !ends_line) ++at_;
    }
    decoded += text_[at_];
  }
  fail(std::string(purpose) + " has no closing quotation mark on its line");
}

std::string Tokenizer::material() {
  skip_whitespace();
  if (at_ < text_.size() && text_[at_] == '"') return quoted(Quoted::kName, "the material");
  const std::size_t begin = at_;
  const std::string_view token = blank_token();
  const bool symbol = token.size() == 1 && kSymbols.find(token[0]) != std::string_view::npos;
  if (token.empty() || symbol || token.starts_with("//")) {
    at_ = begin;
    fail("expected the name of a material, found " + describe_next());
  }
  if (token.size() > kMaxKeyBytes) {
    fail("the material's name is longer than " + std::to_string(kMaxKeyBytes) + " bytes");
  }
  return std::string(token);
}

/// The next word of a block; a comment or a quoted text as a word of its own, empty at the end of the text.
std::string_view Tokenizer::raw_token() {
  skip_whitespace();
  const std::string_view rest = text_.substr(at_);
  if (rest.starts_with("//") || rest.starts_with(';')) {
    at_ += std::min(rest.find('\n'), rest.size());
    return "//";
  }
  if (!rest.starts_with('"')) return blank_token();
  at_ += std::min(rest.find_first_of("\"\n", 1), rest.size());
  if (at_ < text_.size() && text_[at_] == '"') ++at_;
  return "\"\"";
}

std::string Tokenizer::block() {
  skip_whitespace();
  const std::size_t begin = at_;
  const int begun = line_;
  const std::string word = "`" + printable(blank_token(), 60) + "`";
  std::string_view token;
  do token = raw_token();
  while (token == "//");
  if (token != "{") {
    const std::string found = token.empty() ? "the end of the file" : "`" + printable(token, 60) + "`";
    fail("expected `{` after " + word + ", found " + found);
  }
  for (std::size_t depth = 1; depth > 0;) {
    token = raw_token();
    if (token == "{") ++depth;
    if (token == "}") --depth;
    if (token.empty()) {
      fail("expected the closing brace of " + word + ", found the end of the file (it begins at line " +
           std::to_string(begun) + ")");
    }
  }
  return std::string(text_.substr(begin, at_ - begin));
}

std::string Tokenizer::describe_next() {
  if (peek() == '\0') return "the end of the file";
  const std::size_t begin = at_;
  std::string_view token = bare_token();
  if (token.empty()) token = text_.substr(begin, 1);
  at_ = begin;
  return "`" + printable(token, 60) + "`";
}

std::vector<std::string> Tokenizer::take_comments() {
  return std::exchange(comments_, {});
}

}  // namespace hallway::map
