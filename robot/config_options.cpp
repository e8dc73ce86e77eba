// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>

#include "host/load/search.hpp"
#include "isolation_options.hpp"
#include "plugin_argument.hpp"
#include "plugin_path.hpp"
#include "plugin_report.hpp"
#include "robot/command.hpp"
#include "shared_options.hpp"

namespace hallway::robot {

void add_config_options(cli::Command& command, ConfigOptions& options) {
  command.argument("config", &options.config, "Configuration: driver, plugins, limits, robot")
      .required()
      .value("CONFIG");
  command.option("--driver", &options.driver, "Another driver than the configuration's: an id or a .so file")
      .value("DRIVER|FILE");
  cli::add_shared(command, cli::Shared::kPlugin, &options.plugin).fallback("the configuration's");
  cli::add_shared(command, cli::Shared::kSet, &options.settings).repeatable();
  add_driver_path_option(command, options.driver_path);
  cli::add_plugin_path_option(command, options.plugin_path);
  cli::add_shared(command, cli::Shared::kInProcess, &options.in_process);
  cli::add_shared(command, cli::Shared::kJson, &options.json);
}

void add_driver_path_option(cli::Command& command, std::vector<std::string>& folders) {
  command
      .option("--driver-path", &folders,
              "Folder to look for drivers in, before those of HALLWAY_DRIVER_PATH and Hallway's own")
      .value("DIR")
      .repeatable();
}

std::vector<Override> overrides_of(const ConfigOptions& options) {
  std::vector<Override> overrides;
  if (!options.driver.empty()) overrides.push_back({"driver", options.driver});
  if (!options.plugin.empty())
    std::ranges::move(cli::plugin_overrides(options.plugin), std::back_inserter(overrides));
  for (const std::string& text : options.settings) overrides.push_back(cli::parse_setting(text));
  return overrides;
}

std::vector<std::filesystem::path> driver_folders(const std::vector<std::string>& given) {
  return cli::search_folders(given, "HALLWAY_DRIVER_PATH", host::default_driver_folder());
}

Surroundings surroundings_of(const ConfigOptions& options, const host::PluginLimits& limits) {
  cli::IsolationOptions isolation;
  isolation.in_process = options.in_process;
  return {.driver_folders = driver_folders(options.driver_path),
          .plugin_folders = cli::plugin_folders(options.plugin_path),
          .isolation = cli::isolation_of(isolation, limits),
          .log = cli::print_plugin_log};
}

}  // namespace hallway::robot
