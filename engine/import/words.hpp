// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hallway::import {

/// A text with the capitals of ASCII in lower case.
std::string lower_case(std::string_view text);

/// Replaces `words` by the words of a line, which blanks part.
void split_words(std::string_view line, std::vector<std::string_view>& words);

/// A number as point clouds in text have it: a decimal, or a word for one that is not finite (nan, inf, in any case and with a sign).
std::optional<double> parse_coordinate(std::string_view word);

/// A time in seconds, to the nearest nanosecond; exact where it is a plain decimal. From 0 to below 9e9, so that stamps in milli- or
/// nanoseconds since 1970 are refused.
std::optional<std::int64_t> parse_seconds(std::string_view word);

/// The same for a number that was read already.
std::optional<std::int64_t> seconds_to_ns(double seconds);

}  // namespace hallway::import
