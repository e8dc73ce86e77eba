// SPDX-License-Identifier: MIT
#pragma once

#include "command.hpp"

namespace hallway::cli {

/// Each adds its subcommand to the group `hallway map`.
void add_map_check_command(Command& group);
void add_map_info_command(Command& group);
void add_map_leak_command(Command& group);
void add_map_pvs_command(Command& group);
void add_map_ray_command(Command& group);
void add_map_export_command(Command& group);

}  // namespace hallway::cli
