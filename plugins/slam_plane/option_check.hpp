// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <stdexcept>

namespace hallway::slam_plane {

/// Throws std::invalid_argument that names the first parameter out of range, its value and its range. A row has a name, unit, least and greatest value, and a pointer to the member, `real` or
/// `whole`, the other one null.
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
