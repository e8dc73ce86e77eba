// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command_line.hpp"

namespace hallway::cli {

/// Adds `--plugin-path DIR`, which may stand several times.
void add_plugin_path_option(Command& command, std::vector<std::string>& folders);

/// Where plugins are looked for: the folders given, those of the environment variable HALLWAY_PLUGIN_PATH (separated by
/// colons), then the program's own.
std::vector<std::filesystem::path> plugin_folders(const std::vector<std::string>& given);

}  // namespace hallway::cli
