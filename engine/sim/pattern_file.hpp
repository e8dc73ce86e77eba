// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sense/ray_pattern.hpp"

namespace hallway::sim {

/// The beams of a scan from a table: columns `azimuth_deg`, `elevation_deg` and `t_s`, when a beam is measured after the scan's begin, in any order of
/// columns and times; perhaps `ring`. The pattern is not organised. Throws Error{kBadInput} with file and line for a number that is not finite or out of
/// range, a time before 0 or not before the scan's end, no beam, and more than sense::kMostRays.
/// @param file    its name, for messages
/// @param scan_s  how long a scan takes, above 0
sense::RayPattern parse_pattern(std::string_view text, const std::string& file, double scan_s);

/// parse_pattern() of a file. Throws Error{kIo} if it cannot be read.
sense::RayPattern read_pattern_file(const std::filesystem::path& file, double scan_s);

}  // namespace hallway::sim
