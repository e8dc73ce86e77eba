// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/error.hpp"

namespace hallway {

// Where a value of a run came from: a line of a file, or the command line.

/// Where::file of what the command line gave, if no option is named.
inline constexpr const char* kCommandLine = "command line";

/// "office.toml:12" for a line of a file, kCommandLine for line 0.
std::string origin_of(const std::string& file, int line);

/// True where the file is kCommandLine or an option, such as "--set".
bool is_command_line(const Where& where);

/// What a wrong value is: kUsage if the command line gave it, else kBadInput.
ErrorCode wrong_value_at(const Where& where);

}  // namespace hallway
