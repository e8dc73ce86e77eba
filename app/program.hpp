// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace hallway::cli {

/// What `--help` says of exit statuses.
inline constexpr const char* kExitStatusHelp =
    "Exit status: 0 done; 1 ran, and the answer is no; 2 usage; 3 bad input or I/O; 4 plugin not loadable;\n"
    "5 plugin misbehaved; 6 a bug in Hallway; 130 interrupted.";

/// Whether `--json` is among the arguments, wherever: failures are told so before they are parsed.
bool asks_for_json(int argc, char** argv);

/// Parses the arguments by the program's commands and does what they ask for; help and the version are printed, and an argument that is wrong
/// is reported. @return the exit status. Throws Error{kUsage} for a command that there is not, and what the command throws.
int run_program(const Command& program, int argc, char** argv);
/// The same; the program's name is the first of the arguments.
int run_program(const Command& program, std::vector<std::string> arguments);

/// The command of that name directly below `group`. Throws Error{kUsage} with the nearest name and all of them.
const Command& command_below(const Command& group, const std::string& name);

}  // namespace hallway::cli
