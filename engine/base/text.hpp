// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hallway {

/// The shortest decimal that reads back as the same double ("0.1", "1e+30", "-0", "nan", "inf").
std::string format_double(double value);
/// The same, appended to `out` (no temporary).
void append_double(std::string& out, double value);

/// A finite decimal number that is the whole of `text`, independent of the locale; nothing else (no hex, "nan", "inf",
/// leading "+" or spaces).
std::optional<double> parse_double(std::string_view text);
/// A whole decimal number that is the whole of `text` and fits.
std::optional<std::int64_t> parse_int(std::string_view text);
/// As parse_int() for numbers without a sign.
std::optional<std::uint64_t> parse_uint(std::string_view text);

/// Text from outside, safe to show: control characters and invalid UTF-8 become escapes such as \x1b, and what is longer
/// than `max_bytes` is cut with an ellipsis.
std::string printable(std::string_view text, std::size_t max_bytes = 200);

/// The candidate nearest to `name` by edit distance, if it is near enough to be a likely misspelling.
std::optional<std::string> nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// ` (did you mean "x"?)` for the nearest candidate, else the empty text.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

/// The parts of `text` between separators; "a,,b" has three, "" has one.
std::vector<std::string_view> split(std::string_view text, char separator);

/// `text` without spaces, tabs and carriage returns at both ends.
std::string_view trim(std::string_view text);

}  // namespace hallway
