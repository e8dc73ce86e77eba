// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <sstream>
#include <stdexcept>

namespace hallway::em {

/// One row of the table that describes an algorithm's options to a host. Exactly one of `real` and `whole` is set.
template <typename Options>
struct OptionRow {
  const char* name;
  const char* unit;  ///< "length" (the cloud's own unit), "deg", "1" (a ratio), or what is counted
  double min;        ///< smallest value allowed
  double max;        ///< largest value allowed
  const char* help;  ///< one sentence
  double Options::*real;
  int Options::*whole;

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
void check_ranges(const Options& options, std::span<const OptionRow<Options>> rows) {
  for (const OptionRow<Options>& row : rows) {
    const double value = row.get(options);
    if (value >= row.min && value <= row.max) continue;
    std::ostringstream text;
    text << row.name << " is " << value << ' ' << row.unit << "; it must be between " << row.min << " and "
         << row.max;
    throw std::invalid_argument(text.str());
  }
}

}  // namespace hallway::em
