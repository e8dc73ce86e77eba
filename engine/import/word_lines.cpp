// SPDX-License-Identifier: MIT
#include "import/word_lines.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "import/words.hpp"

namespace hallway::import {

bool WordLines::next() {
  if (!lines_.next()) return false;
  constexpr std::size_t kMaxLineBytes = 1u << 20;
  if (lines_.line().size() > kMaxLineBytes) {
    throw error(fmt::format("a line of {} bytes; at most {} are read", lines_.line().size(), kMaxLineBytes));
  }
  split_words(lines_.line(), words_);
  return true;
}

std::string_view WordLines::rest() const {
  const std::string_view current = lines_.line();
  const auto after = static_cast<std::size_t>(current.data() + current.size() - content_.data());
  return content_.substr(content_.find('\n', after) + 1);
}

std::uint64_t WordLines::whole(std::size_t index, std::uint64_t most) const {
  const std::string_view word = index < words_.size() ? words_[index] : std::string_view();
  const auto value = parse_uint(word);
  if (!value || *value > most) {
    throw error(fmt::format("a whole number up to {} is needed, \"{}\" found", most, printable(word, 40)));
  }
  return *value;
}

}  // namespace hallway::import
