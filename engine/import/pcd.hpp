// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "import/point_collector.hpp"

namespace hallway::import {

/// Gives the points of a PCD file (Point Cloud Library, versions up to 0.7) to `out`: data ascii, binary and binary_compressed; x, y and z of
/// any type among any other fields. Of a cloud with HEIGHT above 1 they are the
/// pixels of an image. The viewpoint is not used. Throws Error{kBadInput} with file and line.
///
/// @param content  the file's bytes
/// @param file     its name, for messages
void read_pcd(std::string_view content, const std::string& file, PointCollector& out);

}  // namespace hallway::import
