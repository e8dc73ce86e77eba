// SPDX-License-Identifier: MIT
#include "command.hpp"

namespace hallway::cli {

void add_log_command(Command& app) {
  Command& group = app.command("log", "Inspect, cut, recover and convert recorded logs");
  add_log_info_command(group);
  add_log_frame_command(group);
  add_log_cut_command(group);
  add_log_recover_command(group);
  add_log_convert_command(group);
  group.footer("Example: hallway log info out/office/run.mcap");
}

}  // namespace hallway::cli
