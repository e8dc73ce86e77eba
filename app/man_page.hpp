// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"

namespace hallway::cli {

/// The manual page of a command in section 1, in the macros of man(7): "hallway-map-ray" for `hallway map ray`.
std::string print_man_page(const Command& command);

/// The name of its file: "hallway-map-ray.1".
std::string man_page_name(const Command& command);

/// The command and all commands below it, in the order of help.
std::vector<const Command*> with_commands_below(const Command& command);

}  // namespace hallway::cli
