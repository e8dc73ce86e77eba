// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/setting.hpp"
#include "host/pipeline.hpp"

namespace hallway::cli {

/// What `--plugin NAME|FILE[:KEY=VALUE,...]` says: a plugin, and values of its parameters. "FILE.so:ID" names one of several plugins of a file.
struct PluginArgument {
  std::string plugin{};  ///< id or file
  struct Values {
    std::string name{};
    std::vector<std::string> values{};  ///< several where a command tries each: "noise_m=0.01,0.05"
  };
  std::vector<Values> parameters{};
};

/// Reads it; parameters are separated by "," or ":". Throws Error{kUsage}.
PluginArgument parse_plugin_argument(const std::string& text);

/// The same for a command that runs a plugin once. Throws Error{kUsage} for several values of one parameter too.
host::StageSpec parse_plugin(const std::string& text);

/// The same as settings of a scenario or of a robot's configuration: the plugin first, then its parameters.
std::vector<Override> plugin_overrides(const std::string& text);

/// "KEY=VALUE" taken apart. Throws Error{kUsage}.
Override parse_setting(const std::string& text);

/// Throws Error{kUsage} where one of the `--set` values is of a parameter that `--plugin` gives a value too: neither would be the one that was meant.
void refuse_second_values(const std::string& plugin, const std::vector<std::string>& settings);

/// Throws Error{kUsage}: the setting is of a parameter, and several plugins run.
[[noreturn]] void refuse_whose(const Override& setting, const std::vector<std::string>& plugins);

/// Does what `--set PLUGIN.key=value` asks for, or `--set key=value` where there is one stage. @return the stage and the name of the parameter.
/// Throws Error{kUsage} for a plugin that is none of the stages, with the nearest name, and for a parameter that `--plugin` gives a value.
std::pair<const host::StageSpec*, std::string> set_parameter(std::span<host::StageSpec> stages,
                                                             const std::string& text);

}  // namespace hallway::cli
