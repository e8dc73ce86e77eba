// SPDX-License-Identifier: MIT
#include "import/flat_yaml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"

namespace hallway::import {
namespace {

constexpr std::size_t kMaxEntries = 1000;
constexpr std::size_t kMaxListBytes = 1u << 16;

bool is_key_char(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

bool is_quote(char c) {
  return c == '"' || c == '\'';
}

/// A line up to its comment: a `#` at the beginning or after a blank, and not within a quoted value.
std::string_view before_comment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool begins = i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t';
    if (quote != 0) {
      if (line[i] == quote) quote = 0;
    } else if (begins && is_quote(line[i])) {
      quote = line[i];
    } else if (begins && line[i] == '#') {
      return line.substr(0, i);
    }
  }
  return line;
}

}  // namespace

/// Goes through the lines of a file.
class FlatYaml::Parser {
 public:
  Parser(std::string_view text, FlatYaml& out) : rest_(text), out_(out) {}

  void parse() {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      ++line_;
      read_line(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
    }
    if (in_list_) throw wrong("the file ends within a list: it seems to be cut off");
  }

 private:
  Error wrong(const std::string& message) const {
    return Error(ErrorCode::kBadInput, message, {.file = out_.file_, .line = line_});
  }

  void read_line(std::string_view whole) {
    const std::string_view line = before_comment(whole);
    const std::string_view content = trim(line);
    if (content.empty()) return;
    if (in_list_) return add_to_list(content);
    const bool first = out_.entries_.empty();
    if (first && (content.starts_with("%YAML") || content == "---")) return;
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    if (line[indent] == '\t') throw wrong("a tab at the beginning of a line; YAML is indented with blanks");
    read_entry(indent, content);
  }

  void read_entry(std::size_t indent, std::string_view content) {
    std::size_t end = 0;
    while (end < content.size() && is_key_char(content[end])) ++end;
    const bool is_entry = end > 0 && end < content.size() && content[end] == ':' &&
                          (end + 1 == content.size() || content[end + 1] == ' ' || content[end + 1] == '\t');
    if (!is_entry)
      throw wrong(fmt::format("\"key: value\" is needed, \"{}\" found; other YAML is not read",
                              printable(content, 40)));
    const std::string_view key = content.substr(0, end);
    std::string_view value = trim(content.substr(end + 1));
    constexpr std::string_view kTag = "!!opencv-matrix";
    if (value.starts_with(kTag)) value = trim(value.substr(kTag.size()));
    if (indent == 0) {
      parent_ = value.empty() ? std::string(key) : std::string();
      child_indent_ = 0;
      add(std::string(key), value);
      return;
    }
    if (parent_.empty() || (child_indent_ != 0 && indent != child_indent_))
      throw wrong("the line is indented, and belongs to no key above it");
    if (value.empty()) throw wrong("an indented key needs a value; deeper levels are not read");
    child_indent_ = indent;
    add(fmt::format("{}.{}", parent_, key), value);
  }

  void add(std::string key, std::string_view value) {
    if (out_.has(key)) throw wrong(fmt::format("{} is there twice", printable(key, 40)));
    if (out_.entries_.size() == kMaxEntries) throw wrong("too many keys");
    out_.entries_.push_back({.key = std::move(key), .value = {}, .list = false, .line = line_});
    if (value.empty()) return;
    if (value.front() == '[') {
      out_.entries_.back().list = in_list_ = true;
      const std::string_view inside = trim(value.substr(1));
      if (!inside.empty()) add_to_list(inside);
    } else {
      out_.entries_.back().value = text_of(value);
    }
  }

  void add_to_list(std::string_view content) {
    const std::size_t end = content.find(']');
    std::string& value = out_.entries_.back().value;
    value += content.substr(0, end);
    value += ' ';
    if (value.size() > kMaxListBytes) throw wrong("a list is too long");
    if (end == std::string_view::npos) return;
    in_list_ = false;
    if (!trim(content.substr(end + 1)).empty()) throw wrong("something follows a list");
  }

  std::string text_of(std::string_view value) const {
    if (is_quote(value.front())) {
      const std::size_t end = value.find(value.front(), 1);
      if (end == std::string_view::npos) throw wrong("a quoted text does not end in its line");
      const std::string_view inside = value.substr(1, end - 1);
      if (end + 1 != value.size() || inside.find('\\') != std::string_view::npos)
        throw wrong("a quoted text with quotes or backslashes in it is not read");
      return std::string(inside);
    }
    const bool special = std::string_view("{}]&*!|>@`%?,").find(value.front()) != std::string_view::npos;
    if (special || value.starts_with("- "))
      throw wrong(
          fmt::format("\"{}\" is not read: a text, a number or a list is needed", printable(value, 40)));
    return std::string(value);
  }

  std::string_view rest_;
  FlatYaml& out_;
  int line_ = 0;
  std::string parent_;  ///< the last key without a value; empty where the last key at the margin has one
  std::size_t child_indent_ = 0;
  bool in_list_ = false;
};

FlatYaml::FlatYaml(std::string_view text, const std::string& file) : file_(file) {
  Parser(text, *this).parse();
}

const FlatYaml::Entry* FlatYaml::entry(std::string_view key) const {
  const auto found = std::ranges::find_if(entries_, [&](const Entry& entry) { return entry.key == key; });
  return found == entries_.end() ? nullptr : &*found;
}

const FlatYaml::Entry& FlatYaml::require(std::string_view key, bool list) const {
  const Entry* found = entry(key);
  if (found == nullptr) throw Error(ErrorCode::kBadInput, fmt::format("has no key {}", key), {.file = file_});
  if (found->list != list) throw error(key, list ? "a list is needed" : "one value is needed, not a list");
  return *found;
}

const std::string& FlatYaml::text(std::string_view key) const {
  return require(key, false).value;
}

double FlatYaml::number(std::string_view key, double low, double high) const {
  const std::string& word = text(key);
  const auto number = parse_double(word);
  if (number && *number >= low && *number <= high) return *number;
  throw error(
      key, fmt::format("a number from {:g} to {:g} is needed, \"{}\" found", low, high, printable(word, 40)));
}

std::vector<double> FlatYaml::numbers(std::string_view key, std::size_t count) const {
  std::vector<double> numbers;
  const auto words = split(require(key, true).value, ',');
  if (words.size() != count)
    throw error(key, fmt::format("{} numbers where {} are needed", words.size(), count));
  for (const std::string_view word : words) {
    const auto number = parse_double(trim(word));
    if (!number)
      throw error(key, fmt::format("a finite number is needed, \"{}\" found", printable(trim(word), 40)));
    numbers.push_back(*number);
  }
  return numbers;
}

Error FlatYaml::error(std::string_view key, const std::string& message) const {
  const Entry* found = entry(key);
  return Error(
      ErrorCode::kBadInput, message,
      {.file = file_, .line = found == nullptr ? 0 : found->line, .element = fmt::format("key {}", key)});
}

}  // namespace hallway::import
