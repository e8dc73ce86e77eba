// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "import/recording.hpp"

namespace hallway::import {

/// Points of frames, with the number under which the recording knows each.
struct PointTable {
  std::vector<std::int64_t> t_ns;  ///< by frame; they do not decrease
  std::vector<std::size_t> begin;  ///< by frame: where its points begin; one more for the end
  PointList points;                ///< sensor frame (x forward, y left, z up), metres
  std::vector<std::uint64_t> ids;  ///< by point

  std::uint32_t frames() const { return static_cast<std::uint32_t>(t_ns.size()); }
};

/// What the three numbers of a line are.
enum class PointColumns {
  kCamera,     ///< x_right_m, y_down_m, z_fwd_m
  kSpherical,  ///< range_m, yaw_rad (to the left), pitch_rad (downwards)
};

/// Reads a table with a line for each point: `frame`, `id`, the three columns, and perhaps `t_s`, in any order among any others. Frame numbers do not
/// decrease; frames that have no line are empty, up to 1000 of them in a row. Times: those of the lines, the same throughout a frame; a frame without a line lies in proportion
/// between its neighbours; without a column `t_s` frame i lies at i periods. Throws Error{kBadInput} with the line of the first thing that is wrong,
/// also for a file that is cut off or without points, and for an id that stands twice in a frame.
PointTable parse_point_table(std::string_view text, const std::string& file, PointColumns columns,
                             std::int64_t period_ns);

/// The columns that the header of a table of points has; empty for other files. Only the first line is looked at.
std::optional<PointColumns> point_columns_of(std::string_view first_line);

}  // namespace hallway::import
