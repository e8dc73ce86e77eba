// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "log/row_writer.hpp"

namespace hallway::log {

/// What the plugins of an iteration took.
struct IterationTime {
  std::uint32_t iteration = 0;
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  ///< of the calling thread
};

/// The first line of the table.
inline constexpr std::string_view kTimingColumns = "iteration,wall_ms,cpu_ms";

/// Adds a row. Throws Error{kInternal} for a number that is not finite.
inline void add_row(RowWriter& out, const IterationTime& time) {
  out.whole(time.iteration).number(time.wall_ms).number(time.cpu_ms).end_row();
}

}  // namespace hallway::log
