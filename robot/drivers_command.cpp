// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "console.hpp"
#include "host/load/search.hpp"
#include "host/machine/machine_profile.hpp"
#include "robot/command.hpp"
#include "shared_options.hpp"

namespace hallway::robot {
namespace {

namespace fs = std::filesystem;
using cli::Json;

struct DriversOptions {
  std::vector<std::string> driver_path;
  bool json = false;
};

Json describe(const host::Listed& listed) {
  Json drivers = Json::array();
  for (const host::DriverInfo& info : listed.drivers) {
    Json settings = Json::array();
    for (const host::DriverSettingInfo& setting : info.settings) {
      settings.push_back({{"key", setting.key}, {"help", setting.help}});
    }
    drivers.push_back({{"id", info.id},
                       {"name", info.name},
                       {"version", info.version},
                       {"vendor", info.vendor},
                       {"description", info.description},
                       {"settings", settings}});
  }
  Json entry{{"file", cli::path_text(listed.file)}, {"drivers", drivers}};
  if (!listed.problem.empty()) entry["problem"] = listed.problem;
  return entry;
}

std::string table(const std::vector<host::Listed>& files, const std::vector<fs::path>& folders) {
  std::string text;
  for (const host::Listed& listed : files) {
    for (const host::DriverInfo& info : listed.drivers) {
      text += fmt::format("{:<12} {:<8} {}\n{:<21} {}\n", info.id, info.version, info.description, "",
                          cli::path_text(listed.file));
      std::size_t width = 0;
      for (const host::DriverSettingInfo& setting : info.settings)
        width = std::max(width, setting.key.size());
      for (const host::DriverSettingInfo& setting : info.settings) {
        text += fmt::format("  {:<{}}  {}\n", setting.key, width, setting.help);
      }
    }
    if (!listed.problem.empty())
      text += fmt::format("{:<12} {:<8} {}\n", "(not loadable)", "", listed.problem);
  }
  if (!text.empty()) return text;
  text = "no drivers found; searched:\n";
  for (const fs::path& folder : folders) text += "  " + cli::path_text(folder) + "\n";
  return text;
}

int list(const DriversOptions& options) {
  const std::vector<fs::path> folders = driver_folders(options.driver_path);
  const std::vector<host::Listed> files = host::list_libraries(folders);
  if (!options.json) {
    cli::print_result(table(files, folders));
    return 0;
  }
  Json entries = Json::array();
  for (const host::Listed& listed : files) entries.push_back(describe(listed));
  cli::print_json({{"schema", "hallway.drivers/1"}, {"files", entries}});
  return 0;
}

}  // namespace

void add_drivers_command(cli::Command& app) {
  cli::Command& command = app.command("drivers", "List the drivers that are found, with their settings");
  DriversOptions& options = command.runs(&list);
  add_driver_path_option(command, options.driver_path);
  cli::add_shared(command, cli::Shared::kJson, &options.json);
}

void add_profile_command(cli::Command& app) {
  cli::Command& command = app.command(
      "profile",
      "Print what this machine offers to plugins, for `hallway plugin check FILE --profile PROFILE`");
  command.footer("Example: hallway-robot profile > robot-profile.toml");
  command.action([] {
    cli::print_result(host::print_profile(host::this_machine()));
    return 0;
  });
}

}  // namespace hallway::robot
