// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace hallway::cli {

/// What the command line asks for; called once it is parsed. @return the exit status
using Action = std::function<int()>;

/// What `--help` says of exit statuses.
inline constexpr const char* kExitStatusHelp =
    "Exit status: 0 done; 1 ran, and the answer is no; 2 usage; 3 bad input or I/O; 4 plugin not loadable;\n"
    "5 plugin misbehaved; 6 a bug in Hallway; 130 interrupted.";

/// Whether `--json` is among the arguments, wherever: failures are told so before they are parsed.
bool asks_for_json(int argc, char** argv);

/// Parses the arguments and does what they ask for. @return the exit status. Throws Error{kUsage} for a command that there is not, and
/// what the command throws.
/// @param chosen  set by the commands of `app` while they are parsed
int run_chosen(CLI::App& app, int argc, char** argv, const Action& chosen);

}  // namespace hallway::cli
