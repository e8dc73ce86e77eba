// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "command_line.hpp"

namespace hallway::cli {

/// Adds the commands that both programs have about themselves: `help`, `completion` and `man`. They are about `program` as it is when they run.
void add_help_commands(Command& program);

/// Every command of a program with its options, as `help --json` prints it: schema hallway.commands/1.
nlohmann::ordered_json commands_json(const Command& program);

}  // namespace hallway::cli
