// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "log/row_writer.hpp"

namespace hallway::log {

/// How a plugin wanted the robot to drive, from a frame on.
struct IterationCommand {
  std::uint32_t iteration = 0;
  double linear_m_s = 0.0;     ///< along the body's x axis, forward positive
  double angular_rad_s = 0.0;  ///< about the body's z axis, to the left positive
  double lateral_m_s = 0.0;    ///< along the body's y axis, to the left positive
};

/// The first line of the table.
inline constexpr std::string_view kCommandColumns = "iteration,linear_m_s,angular_rad_s";
/// The first line of a table in which any command moves the robot sideways.
inline constexpr std::string_view kLateralCommandColumns = "iteration,linear_m_s,angular_rad_s,lateral_m_s";

/// Adds a row of kCommandColumns. Throws Error{kInternal} for a number that is not finite.
inline void add_row(RowWriter& out, const IterationCommand& command) {
  out.whole(command.iteration).number(command.linear_m_s).number(command.angular_rad_s).end_row();
}

/// Adds a row of kLateralCommandColumns. Throws as add_row().
inline void add_lateral_row(RowWriter& out, const IterationCommand& command) {
  out.whole(command.iteration).number(command.linear_m_s).number(command.angular_rad_s);
  out.number(command.lateral_m_s).end_row();
}

/// The text of the table. It has the column lateral_m_s where any command is not 0 in it. Throws as add_row().
std::string print_commands(std::span<const IterationCommand> commands);

}  // namespace hallway::log
