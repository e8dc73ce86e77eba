// SPDX-License-Identifier: MIT
#include "import/words.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"

namespace hallway::import {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::int64_t kNanoseconds = 1'000'000'000;
constexpr std::int64_t kSecondsEnd = 9'000'000'000;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Digits behind the point as nanoseconds, rounded by the tenth.
std::int64_t fraction_ns(std::string_view digits) {
  std::int64_t value = 0;
  for (std::size_t i = 0; i < 9; ++i) value = 10 * value + (i < digits.size() ? digits[i] - '0' : 0);
  return value + (digits.size() > 9 && digits[9] >= '5' ? 1 : 0);
}

}  // namespace

void split_words(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  for (;;) {
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return;
    line.remove_prefix(begin);
    words.push_back(line.substr(0, line.find_first_of(kBlanks)));
    line.remove_prefix(words.back().size());
  }
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

std::optional<double> parse_coordinate(std::string_view word) {
  if (const auto number = parse_double(word)) return number;
  if (word.starts_with('+')) {
    if (const auto number = parse_double(word.substr(1)); number && !word.substr(1).starts_with('-')) {
      return number;
    }
  }
  const std::string plain = lower_case(word.substr(word.starts_with('-') || word.starts_with('+') ? 1 : 0));
  if (plain == "nan" || plain == "inf" || plain == "infinity" || plain == "nan(ind)") {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::nullopt;
}

std::optional<std::int64_t> parse_seconds(std::string_view word) {
  const std::size_t point = std::min(word.find('.'), word.size());
  const std::string_view whole = word.substr(0, point);
  const std::string_view fraction = word.substr(std::min(point + 1, word.size()));
  const bool plain = !whole.empty() && std::all_of(whole.begin(), whole.end(), is_digit) &&
                     std::all_of(fraction.begin(), fraction.end(), is_digit);
  if (!plain) {
    const auto number = parse_double(word);
    return number ? seconds_to_ns(*number) : std::nullopt;
  }
  const auto seconds = parse_int(whole);
  if (!seconds || *seconds >= kSecondsEnd) return std::nullopt;
  return *seconds * kNanoseconds + fraction_ns(fraction);
}

std::optional<std::int64_t> seconds_to_ns(double seconds) {
  if (!(seconds >= 0.0 && seconds < static_cast<double>(kSecondsEnd))) return std::nullopt;
  return std::llround(seconds * static_cast<double>(kNanoseconds));
}

}  // namespace hallway::import
