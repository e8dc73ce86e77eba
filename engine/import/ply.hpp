// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "import/point_collector.hpp"

namespace hallway::import {

/// Gives the vertices of a PLY file to `out`: text, binary of either byte order; x, y and z of any type among any other properties that are no
/// lists; `vertex` is the first element, and what follows it is not read. Throws Error{kBadInput} with file and line.
///
/// @param content  the file's bytes
/// @param file     its name, for messages
void read_ply(std::string_view content, const std::string& file, PointCollector& out);

}  // namespace hallway::import
