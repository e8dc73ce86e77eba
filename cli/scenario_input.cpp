// SPDX-License-Identifier: MIT
#include "scenario_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "console.hpp"
#include "map/reader.hpp"
#include "map/robot_file.hpp"
#include "plugin_argument.hpp"
#include "run/pictures/record.hpp"
#include "sim/default_scenario.hpp"

namespace hallway::cli {

namespace {

/// A scenario, and the text that it was read from.
struct ScenarioInput {
  sim::Scenario scenario{};
  std::string text{};
};

/// Reads a scenario file, or makes a scenario for a `.map` file and prints what it assumes.
ScenarioInput read_scenario_input(const fs::path& path, std::span<const Override> overrides) {
  if (path.extension() != ".map") {
    ScenarioInput input{.scenario = sim::load_scenario(path, overrides)};
    input.text = read_file(path, sim::kMaxScenarioBytes);
    return input;
  }
  const map::Document document = map::load(path);
  map::require_world(document);
  sim::DefaultScenario made = sim::default_scenario(document, path.filename().string());
  for (const sim::Assumption& one : made.assumed) {
    const bool is_untrue = std::ranges::any_of(one.unless, [&](const std::string& key) {
      return std::ranges::find(overrides, key, &Override::key) != overrides.end();
    });
    if (!is_untrue) print_notice(one.text);
  }
  print_notice(fmt::format("`hallway scenario new {}` writes this scenario", path_text(path)));
  fs::path as_file = path;
  as_file.replace_extension(".toml");
  return {.scenario = sim::parse_scenario(made.text, as_file, overrides), .text = std::move(made.text)};
}

/// What the user should know of the map, printed too. Throws the first of it if `strict`.
std::vector<std::string> take_warnings(const sim::Simulator& simulator, bool strict) {
  std::vector<std::string> warnings;
  for (const Error& problem : simulator.problems()) {
    if (strict) throw problem;
    print_warning(warnings, problem.what());
  }
  return warnings;
}

}  // namespace

OpenedScenario open_scenario(const std::string& file, std::span<const Override> overrides, unsigned threads,
                             bool strict) {
  const ScenarioInput read = read_scenario_input(file, overrides);
  OpenedScenario opened{
      .simulator = std::make_unique<sim::Simulator>(read.scenario, threads, trace::Backend::kEmbree)};
  const sim::Scenario& scenario = opened.simulator->scenario();
  opened.facts = {.command = {},
                  .name = fs::path(scenario.file).stem().string(),
                  .settings = scenario.settings,
                  .warnings = take_warnings(*opened.simulator, strict),
                  .period_ns = scenario.period_ns,
                  .threads = threads};
  auto& inputs = opened.facts.inputs;
  inputs = {{fs::path(scenario.file).filename().string(), read.text},
            {scenario.map_file.filename().string(), read_file(scenario.map_file)}};
  opened.attachments = {{run::files::kScenario, inputs[0].content}, {run::files::kMap, inputs[1].content}};
  if (!scenario.robot_file.empty()) {
    inputs.push_back({scenario.robot_file.filename().string(), read_file(scenario.robot_file)});
    opened.attachments.push_back({run::files::kRobotFile, inputs.back().content});
  }
  if (const auto& driven = scenario.robot.driven; driven && !driven->commands.empty())
    inputs.push_back({driven->commands.filename().string(), read_file(driven->commands)});
  const fs::path folder = scenario.map_file.parent_path();
  for (const fs::path& model : opened.simulator->models().files) {
    inputs.push_back({model.lexically_relative(folder.empty() ? fs::path(".") : folder).generic_string(),
                      read_file(model)});
    opened.attachments.push_back(inputs.back());
  }
  return opened;
}

std::vector<Override> scenario_overrides(const std::vector<std::string>& settings,
                                         const std::optional<std::uint64_t>& seed,
                                         const std::optional<std::uint32_t>& steps) {
  std::vector<Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(parse_setting(setting));
  if (seed) overrides.push_back({"seed", fmt::to_string(*seed)});
  if (steps) overrides.push_back({"steps", fmt::to_string(*steps)});
  return overrides;
}

}  // namespace hallway::cli
