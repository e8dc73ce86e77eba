// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace hallway {

/// One row of the table that describes an algorithm's options to a host: a member of `Options` that is a number. Exactly one of `real` and `whole` is set.
template <typename Options>
struct OptionRow {
  const char* name = nullptr;
  const char* unit =
      nullptr;       ///< "m", "rad", "1" (a ratio), "length" (the cloud's own unit), or what is counted
  double min = 0.0;  ///< smallest value allowed
  double max = 0.0;  ///< largest value allowed
  const char* help = nullptr;  ///< one sentence
  double Options::*real = nullptr;
  int Options::*whole = nullptr;

  constexpr OptionRow() = default;
  constexpr OptionRow(const char* row, const char* in, double least, double most, const char* says,
                      double Options::*member)
      : name(row), unit(in), min(least), max(most), help(says), real(member) {}
  constexpr OptionRow(const char* row, const char* in, double least, double most, const char* says,
                      int Options::*member)
      : name(row), unit(in), min(least), max(most), help(says), whole(member) {}

  /// The value that `options` holds.
  double get(const Options& options) const {
    return real != nullptr ? options.*real : static_cast<double>(options.*whole);
  }
  /// Stores `value` unchecked (whole ones are truncated).
  void set(Options& options, double value) const {
    if (real != nullptr) {
      options.*real = value;
    } else {
      options.*whole = static_cast<int>(value);
    }
  }
};

/// Throws std::invalid_argument that names the first option out of range, its value and its range.
template <typename Options>
void check_options(const Options& options, std::span<const OptionRow<Options>> rows) {
  for (const OptionRow<Options>& row : rows) {
    const double value = row.get(options);
    if (value >= row.min && value <= row.max) continue;
    std::ostringstream text;
    text << row.name << " is " << value << ' ' << row.unit << "; it must be between " << row.min << " and "
         << row.max;
    throw std::invalid_argument(text.str());
  }
}

/// The row of that name, or null.
template <typename Options>
const OptionRow<Options>* find_option(std::span<const OptionRow<Options>> rows, std::string_view name) {
  for (const OptionRow<Options>& row : rows) {
    if (name == row.name) return &row;
  }
  return nullptr;
}

/// One table after the other.
template <typename Row, std::size_t A, std::size_t B>
constexpr std::array<Row, A + B> joined_rows(const std::array<Row, A>& a, const std::array<Row, B>& b) {
  std::array<Row, A + B> rows{};
  for (std::size_t i = 0; i < A; ++i) rows[i] = a[i];
  for (std::size_t i = 0; i < B; ++i) rows[A + i] = b[i];
  return rows;
}

}  // namespace hallway
