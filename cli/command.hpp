// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hallway::cli {

/// What the command line asks for; called once it is parsed. @return the exit status
using Action = std::function<int()>;

/// Each adds its subcommand to `app`, which sets `chosen` when it is the one that is asked for.
void add_run_command(CLI::App& app, Action& chosen);
void add_replay_command(CLI::App& app, Action& chosen);
void add_log_command(CLI::App& app, Action& chosen);
void add_render_command(CLI::App& app, Action& chosen);
void add_batch_command(CLI::App& app, Action& chosen);
void add_compare_command(CLI::App& app, Action& chosen);
void add_doctor_command(CLI::App& app, Action& chosen);
void add_plugin_command(CLI::App& app, Action& chosen);
void add_import_command(CLI::App& app, Action& chosen);
void add_compile_command(CLI::App& app, Action& chosen);
void add_map_command(CLI::App& app, Action& chosen);
void add_edit_command(CLI::App& app, Action& chosen);

/// Each adds its subcommand to `hallway plugin`.
void add_plugin_check_command(CLI::App& plugin, Action& chosen);
void add_plugin_info_command(CLI::App& plugin, Action& chosen);
void add_plugin_new_command(CLI::App& plugin, Action& chosen);
void add_plugin_validate_command(CLI::App& plugin, Action& chosen);

/// Adds `--plugin-path DIR`, which may stand several times.
void add_plugin_path_option(CLI::App& command, std::vector<std::string>& folders);

/// Where plugins are looked for: the folders given, those of the environment variable HALLWAY_PLUGIN_PATH (separated by
/// colons), then the program's own.
std::vector<std::filesystem::path> plugin_folders(const std::vector<std::string>& given);

}  // namespace hallway::cli
