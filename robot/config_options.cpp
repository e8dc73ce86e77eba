// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdlib>

#include "base/error.hpp"
#include "base/text.hpp"
#include "host/search.hpp"
#include "isolation_options.hpp"
#include "plugin_path.hpp"
#include "plugin_report.hpp"
#include "robot/command.hpp"

namespace hallway::robot {

void add_config_options(cli::Command& command, ConfigOptions& options) {
  command.argument("config", &options.config, "Configuration: driver, plugins, limits, robot")
      .required()
      .value("CONFIG");
  command.option("--driver", &options.driver, "Another driver than the configuration's: an id or a .so file")
      .value("NAME|FILE");
  command
      .option("--plugin", &options.plugin,
              "Run this plugin instead of the configuration's: an id or a .so file")
      .value("NAME|FILE");
  command
      .option("--set", &options.settings,
              "Set a value (robot.rate_hz=50, driver.log=run.mcap, limits.on_failure=restart) or a plugin's "
              "parameter "
              "(slam_point.noise_m=0.1); may be given several times")
      .value("KEY=VALUE")
      .repeatable();
  add_driver_path_option(command, options.driver_path);
  cli::add_plugin_path_option(command, options.plugin_path);
  command.flag("--in-process", &options.in_process,
               "Run plugins in this process, for debuggers: no limits, and a crash is a crash of all");
  command.flag("--json", &options.json, "Print one JSON document");
}

void add_driver_path_option(cli::Command& command, std::vector<std::string>& folders) {
  command
      .option("--driver-path", &folders, "Look for drivers in this folder first; may be given several times")
      .value("DIR")
      .repeatable();
}

std::vector<Override> overrides_of(const ConfigOptions& options) {
  std::vector<Override> overrides;
  if (!options.driver.empty()) overrides.push_back({"driver", options.driver});
  if (!options.plugin.empty()) overrides.push_back({"plugin", options.plugin});
  for (const std::string& text : options.settings) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Error(ErrorCode::kUsage, fmt::format("--set takes key=value, not \"{}\"", printable(text)));
    }
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

std::vector<std::filesystem::path> driver_folders(const std::vector<std::string>& given) {
  std::vector<std::filesystem::path> folders(given.begin(), given.end());
  if (const char* from_environment = std::getenv("HALLWAY_DRIVER_PATH")) {
    for (const std::string_view folder : split(from_environment, ':')) {
      if (!folder.empty()) folders.emplace_back(folder);
    }
  }
  folders.push_back(host::default_driver_folder());
  return folders;
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
