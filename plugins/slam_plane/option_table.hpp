// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <stdexcept>

namespace hallway::slam_plane {

/// One row of a table that describes options to a host. Exactly one of `real` and `whole` is set.
template <typename Options>
struct OptionRow {
  const char* name;
  const char* unit;
  double min;
  double max;
  const char* help;  ///< one sentence
  double Options::*real = nullptr;
  int Options::*whole = nullptr;

  constexpr OptionRow(const char* row, const char* in, double least, double most, const char* says,
                      double Options::*member)
      : name(row), unit(in), min(least), max(most), help(says), real(member) {}
  constexpr OptionRow(const char* row, const char* in, double least, double most, const char* says,
                      int Options::*member)
      : name(row), unit(in), min(least), max(most), help(says), whole(member) {}
};

/// Throws std::invalid_argument that names the first parameter out of range, its value and its range.
template <typename Options, typename Rows>
void check_options(const Options& options, const Rows& rows) {
  for (const auto& row : rows) {
    const double value = row.real != nullptr ? options.*row.real : options.*row.whole;
    if (value >= row.min && value <= row.max) continue;
    std::ostringstream text;
    text << row.name << " is " << value << ' ' << row.unit << "; it must be between " << row.min << " and "
         << row.max;
    throw std::invalid_argument(text.str());
  }
}

}  // namespace hallway::slam_plane
