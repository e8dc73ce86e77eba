// SPDX-License-Identifier: MIT
#pragma once

#include "command.hpp"

namespace hallway::cli {

/// Each adds its subcommand to the group `hallway log`.
void add_log_info_command(CLI::App& group, Action& chosen);
void add_log_cut_command(CLI::App& group, Action& chosen);
void add_log_recover_command(CLI::App& group, Action& chosen);
void add_log_convert_command(CLI::App& group, Action& chosen);

}  // namespace hallway::cli
