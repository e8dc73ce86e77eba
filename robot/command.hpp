// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/setting.hpp"
#include "program.hpp"
#include "robot/session.hpp"

namespace hallway::robot {

/// Each adds its command to the program.
void add_run_command(cli::Command& app);
void add_check_command(cli::Command& app);
void add_drivers_command(cli::Command& app);
void add_profile_command(cli::Command& app);

/// What `run` and `check` both take.
struct ConfigOptions {
  std::string config;
  std::string driver;
  std::string plugin;
  std::vector<std::string> settings;
  std::vector<std::string> driver_path;
  std::vector<std::string> plugin_path;
  bool in_process = false;
  bool json = false;
};

/// Adds CONFIG, --driver, --plugin, --set, --driver-path, --plugin-path, --in-process and --json.
void add_config_options(cli::Command& command, ConfigOptions& options);
/// Adds `--driver-path DIR`, which may stand several times.
void add_driver_path_option(cli::Command& command, std::vector<std::string>& folders);

/// What the command line sets above the file. Throws Error{kUsage}.
std::vector<Override> overrides_of(const ConfigOptions& options);
/// Where drivers are looked for: the folders given, those of HALLWAY_DRIVER_PATH (separated by colons), then the program's own.
std::vector<std::filesystem::path> driver_folders(const std::vector<std::string>& given);
Surroundings surroundings_of(const ConfigOptions& options, const host::PluginLimits& limits);

}  // namespace hallway::robot
