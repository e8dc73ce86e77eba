// SPDX-License-Identifier: MIT
#include "log_command.hpp"

namespace hallway::cli {

void add_log_command(CLI::App& app, Action& chosen) {
  CLI::App* group = app.add_subcommand("log", "Look at recorded logs, cut, mend and convert them");
  group->require_subcommand(1);
  add_log_info_command(*group, chosen);
  add_log_cut_command(*group, chosen);
  add_log_recover_command(*group, chosen);
  add_log_convert_command(*group, chosen);
  group->footer("Example: hallway log info out/office/run.mcap");
}

}  // namespace hallway::cli
