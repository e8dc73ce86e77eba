// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "log/row_writer.hpp"

namespace hallway::log {

/// How a plugin wanted the robot to drive, from a frame on.
struct IterationCommand {
  std::uint32_t iteration = 0;
  double linear_m_s = 0.0;     ///< along the body's x axis, forward positive
  double angular_rad_s = 0.0;  ///< about the body's z axis, to the left positive
};

/// The first line of the table.
inline constexpr std::string_view kCommandColumns = "iteration,linear_m_s,angular_rad_s";

/// Adds a row. Throws Error{kInternal} for a number that is not finite.
inline void add_row(RowWriter& out, const IterationCommand& command) {
  out.whole(command.iteration).number(command.linear_m_s).number(command.angular_rad_s).end_row();
}

}  // namespace hallway::log
