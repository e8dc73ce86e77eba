// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "log/csv_reader.hpp"

namespace hallway::log {

/// The corners of a convex outline in one field of a CSV row: x y z after x y z, with blanks between them, three corners or more; none of an
/// empty field. Throws Error{kBadInput} for anything else.
std::vector<std::array<double, 3>> read_hull(const CsvReader& row, std::size_t column);

/// The field that read_hull() reads back to the same values; of finite numbers.
std::string hull_text(std::span<const std::array<double, 3>> hull_m);

}  // namespace hallway::log
