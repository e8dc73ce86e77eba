// SPDX-License-Identifier: MIT
#include "command.hpp"

namespace hallway::cli {

void add_map_command(Command& app) {
  Command& group =
      app.command("map", "Query a map: check it, list what is in it, find leaks, test visibility, export it");
  add_map_check_command(group);
  add_map_info_command(group);
  add_map_leak_command(group);
  add_map_pvs_command(group);
  add_map_ray_command(group);
  add_map_export_command(group);
  group.footer("Example: hallway map check maps/office.map");
}

}  // namespace hallway::cli
