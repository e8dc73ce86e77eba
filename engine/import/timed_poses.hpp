// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "import/true_track.hpp"
#include "log/row_writer.hpp"

namespace hallway::import {

/// The end of the times that files in seconds may have, so that other units are refused (parse_seconds()).
inline constexpr std::int64_t kTimesEnd_ns = 9'000'000'000'000'000'000;

/// Seconds with nine decimals, exactly the time. @param t_ns  not below 0
std::string format_seconds(std::int64_t t_ns);

/// Reads lines `t x y z qx qy qz qw` (TUM RGB-D benchmark), T_world_body: as log::parse_tum(), but times are exact nanoseconds, and orientations are
/// normalised. Times increase. Throws Error{kBadInput} with the line, also for a position beyond kMaxImport_m and for a file without poses.
std::vector<TimedPose> parse_timed_poses(std::string_view text, const std::string& file);

/// Adds such a line. @param out  separates by blanks
void add_row(log::RowWriter& out, const TimedPose& pose);

/// Whether a pose is finite, lies within kMaxImport_m, and has a unit quaternion.
bool is_sound(const Pose& pose);

}  // namespace hallway::import
