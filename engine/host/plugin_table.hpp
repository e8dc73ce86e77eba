// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/setting.hpp"
#include "base/toml_node.hpp"
#include "host/pipeline.hpp"

namespace hallway::host {

// The [[plugin]] tables of a TOML file, which are the same in a scenario and in a robot's configuration.

/// The name under which `--set NAME.parameter=value` finds a plugin: of a file ("x/slam.so", "x/some.so:slam") that of the
/// plugin in it, without folder and `.so`.
std::string short_plugin_name(const std::string& plugin);

/// A name that stands in a file counts from the file's folder, one on the command line (line 0) from the current folder.
std::filesystem::path beside(const std::filesystem::path& file, const std::string& name, int line);

/// Reads the [[plugin]] tables of `root`, in their order; their effective settings are added to `settings`. A plugin named by a file is
/// named so that it can be opened from the current folder. Throws Error{kBadInput} (Error{kUsage} for what the command line gave) with file, line
/// and key.
std::vector<StageSpec> read_plugin_tables(const std::filesystem::path& file, const TomlTable& root,
                                          std::vector<Setting>& settings);

/// Leaves that plugin alone in the pipeline, with the parameters that `root` has for it, if any.
void leave_plugin_alone(TomlTable& root, const std::string& plugin);

/// Sets a parameter: `key` is "slam_point.noise_m", or "noise_m" where there is one plugin. False if there is no such plugin.
bool set_plugin_parameter(TomlTable& root, std::string_view key, const TomlNode& value);

/// Keys that `wanted` may be a misspelling of: "slam_point.noise_m" for each parameter that is set in `root`, and for each plugin its name with
/// what follows the last point of `wanted`.
std::vector<std::string> plugin_parameter_keys(TomlTable& root, std::string_view wanted);

}  // namespace hallway::host
