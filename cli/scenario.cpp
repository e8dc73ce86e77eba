// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "base/file.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "map/reader.hpp"
#include "output_file.hpp"
#include "shared_options.hpp"
#include "sim/default_scenario.hpp"

namespace hallway::cli {
namespace {

struct ScenarioOptions {
  std::string map;
  std::string out;
  bool force = false;
  bool json = false;
};

/// The map as a scenario in that folder names it.
std::string name_from(const fs::path& folder, const fs::path& map) {
  std::error_code none;
  // As they are reached: `..` behind a symbolic link is another folder than its name says.
  const fs::path from = fs::weakly_canonical(fs::absolute(folder, none), none);
  return fs::weakly_canonical(fs::absolute(map, none), none).lexically_relative(from).generic_string();
}

int write_scenario(const ScenarioOptions& options) {
  fs::path file = options.out;
  if (options.out.empty()) file = fs::path(options.map).replace_extension(".toml");
  const std::string shown = path_text(file);
  check_new_file(file, options.force);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const sim::DefaultScenario made =
      sim::default_scenario(map::load(options.map), name_from(folder, options.map));
  write_file_atomically(file, made.text);
  std::vector<std::string> assumed;
  for (const sim::Assumption& one : made.assumed) assumed.push_back(one.text);
  if (options.json) {
    print_json(
        {{"schema", "hallway.scenario_new/1"}, {"status", 0}, {"written", shown}, {"assumed", assumed}});
    return 0;
  }
  std::string text = "wrote " + shown + "\n";
  for (const std::string& sentence : assumed) text += "  " + sentence + "\n";
  print_result(text);
  return 0;
}

}  // namespace

void add_scenario_command(Command& app) {
  Command& group = app.command("scenario", "Write scenario files");
  Command& command = group.command("new", "Write the scenario that `hallway run MAP` uses, with comments");
  ScenarioOptions& options = command.runs(&write_scenario);
  command.argument("map", &options.map, "A .map file").required().value("MAP");
  add_shared(command, Shared::kOutFile, &options.out).fallback("MAP with .toml at its end");
  add_shared(command, Shared::kForce, &options.force);
  add_shared(command, Shared::kJson, &options.json);
  command.footer("Example: hallway scenario new home.map && hallway run home.toml");
}

}  // namespace hallway::cli
