// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "log/row_writer.hpp"

namespace hallway::log {

/// Which time the pose of an iteration is of, where that is not its frame's.
struct IterationPoseTime {
  std::uint32_t iteration = 0;
  std::int64_t t_ns = 0;  ///< above 0, not later than the frame's
};

/// The first line of the table.
inline constexpr std::string_view kPoseTimeColumns = "iteration,t_ns";

/// Adds a row.
inline void add_row(RowWriter& out, const IterationPoseTime& row) {
  out.whole(row.iteration).whole(static_cast<std::uint64_t>(row.t_ns)).end_row();
}

}  // namespace hallway::log
