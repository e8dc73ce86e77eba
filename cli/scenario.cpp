// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "map/reader.hpp"
#include "shared_options.hpp"
#include "sim/default_scenario.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;

struct ScenarioOptions {
  std::string map;
  std::string out;
  bool force = false;
  bool json = false;
};

/// The map as a scenario in that folder names it.
std::string name_from(const fs::path& folder, const fs::path& map) {
  std::error_code none;
  const fs::path from = fs::absolute(folder, none);
  return fs::absolute(map, none)
      .lexically_normal()
      .lexically_relative(from.lexically_normal())
      .generic_string();
}

int write_scenario(const ScenarioOptions& options) {
  fs::path file = options.out;
  if (options.out.empty()) file = fs::path(options.map).replace_extension(".toml");
  const std::string shown = printable(file.string(), 4096);
  std::error_code none;
  if (!options.force && fs::exists(fs::symlink_status(file, none)))
    throw Error(ErrorCode::kIo, "is there already; --force replaces it", {.file = shown});
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const sim::DefaultScenario made =
      sim::default_scenario(map::load(options.map), name_from(folder, options.map));
  write_file_atomically(file, made.text);
  if (options.json) {
    print_json(
        {{"schema", "hallway.scenario_new/1"}, {"status", 0}, {"written", shown}, {"assumed", made.assumed}});
    return 0;
  }
  std::string text = "wrote " + shown + "\n";
  for (const std::string& sentence : made.assumed) text += "  " + sentence + "\n";
  print_result(text);
  return 0;
}

}  // namespace

void add_scenario_command(Command& app) {
  Command& group = app.command("scenario", "Write scenario files");
  Command& command = group.command("new", "Write the scenario that `hallway run MAP` uses, with comments");
  const auto options = std::make_shared<ScenarioOptions>();
  command.argument("map", &options->map, "A .map file").required().value("MAP");
  add_shared(command, Shared::kOutFile, &options->out).fallback("MAP with .toml at its end");
  add_shared(command, Shared::kForce, &options->force);
  add_shared(command, Shared::kJson, &options->json);
  command.footer("Example: hallway scenario new home.map && hallway run home.toml");
  command.action([options] { return write_scenario(*options); });
}

}  // namespace hallway::cli
