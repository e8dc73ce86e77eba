// SPDX-License-Identifier: MIT
#include "map_command.hpp"

namespace hallway::cli {

void add_map_command(CLI::App& app, Action& chosen) {
  CLI::App* group = app.add_subcommand("map", "Ask a map questions");
  group->require_subcommand(1);
  add_map_check_command(*group, chosen);
  add_map_info_command(*group, chosen);
  add_map_leak_command(*group, chosen);
  add_map_pvs_command(*group, chosen);
  add_map_ray_command(*group, chosen);
  add_map_export_command(*group, chosen);
  group->footer("Example: hallway map check maps/office.map");
}

}  // namespace hallway::cli
