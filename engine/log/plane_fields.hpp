// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "log/csv_reader.hpp"

namespace hallway::log {

/// Four corners from twelve neighbouring columns: x0, y0, z0, x1, … Throws as CsvReader::vector() does.
std::array<std::array<double, 3>, 4> read_corners(const CsvReader& row, std::size_t first_column);

/// The corners of a convex outline in one field of a CSV row: x y z after x y z, with blanks between them, three corners or more; none of an
/// empty field. Throws Error{kBadInput} for anything else.
std::vector<std::array<double, 3>> read_hull(const CsvReader& row, std::size_t column);

/// The field that read_hull() reads back to the same values; of finite numbers.
std::string hull_text(std::span<const std::array<double, 3>> hull_m);

/// Whether a table of these planes needs the column of hulls.
template <typename Planes>
bool any_hull(const Planes& planes) {
  return std::any_of(planes.begin(), planes.end(), [](const auto& plane) { return !plane.hull_m.empty(); });
}

}  // namespace hallway::log
