// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command_line.hpp"

namespace hallway::cli {

/// Adds `--plugin-path DIR`, which may stand several times.
void add_plugin_path_option(Command& command, std::vector<std::string>& folders);

/// Where libraries are looked for: the folders given, those that an environment variable names (separated by colons), then
/// the program's own.
std::vector<std::filesystem::path> search_folders(const std::vector<std::string>& given, const char* variable,
                                                  const std::filesystem::path& own);

/// Where plugins are looked for; the variable is HALLWAY_PLUGIN_PATH.
std::vector<std::filesystem::path> plugin_folders(const std::vector<std::string>& given);

}  // namespace hallway::cli
