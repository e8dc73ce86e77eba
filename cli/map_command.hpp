// SPDX-License-Identifier: MIT
#pragma once

#include "command.hpp"

namespace hallway::cli {

/// Each adds its subcommand to the group `hallway map`.
void add_map_check_command(CLI::App& group, Action& chosen);
void add_map_info_command(CLI::App& group, Action& chosen);
void add_map_leak_command(CLI::App& group, Action& chosen);
void add_map_pvs_command(CLI::App& group, Action& chosen);
void add_map_ray_command(CLI::App& group, Action& chosen);
void add_map_export_command(CLI::App& group, Action& chosen);

}  // namespace hallway::cli
