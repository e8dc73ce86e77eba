// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editor/command.hpp"

namespace hallway::editor {

/// "wall from=X,Y to=X,Y [height=LENGTH] ...": how a command is called.
std::string usage(const CommandSpec& command);

/// All about one command, for a terminal.
std::string help_text(const CommandSpec& command);

/// All commands by topic, a line each.
std::string help_overview();

/// docs/edit.md's part that lists the commands.
std::string reference_markdown();

/// The table of commands for other programs: name, topic, summary, arguments (name, type, required, default, help, choices), example.
nlohmann::ordered_json reference_json();

}  // namespace hallway::editor
