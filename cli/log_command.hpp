// SPDX-License-Identifier: MIT
#pragma once

#include "command.hpp"

namespace hallway::cli {

/// Each adds its subcommand to the group `hallway log`.
void add_log_info_command(Command& group);
void add_log_cut_command(Command& group);
void add_log_recover_command(Command& group);
void add_log_convert_command(Command& group);

}  // namespace hallway::cli
