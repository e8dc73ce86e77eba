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
#include "sim/default_scenario.hpp"

namespace hallway::cli {

namespace fs = std::filesystem;

ScenarioInput read_scenario_input(const std::string& file, std::span<const Override> overrides) {
  const fs::path path = file;
  if (path.extension() != ".map") {
    ScenarioInput input{.scenario = sim::load_scenario(path, overrides)};
    input.text = read_file(path, sim::kMaxScenarioBytes);
    return input;
  }
  sim::DefaultScenario made = sim::default_scenario(map::load(path), path.filename().string());
  std::vector<std::string> assumed;
  for (const sim::Assumption& one : made.assumed) {
    const bool is_untrue = std::ranges::any_of(one.unless, [&](const std::string& key) {
      return std::ranges::find(overrides, key, &Override::key) != overrides.end();
    });
    if (!is_untrue) assumed.push_back(one.text);
  }
  for (const std::string& sentence : assumed) print_notice(sentence);
  print_notice(fmt::format("`hallway scenario new {}` writes this scenario", printable(file, 4096)));
  fs::path as_file = path;
  as_file.replace_extension(".toml");
  return {.scenario = sim::parse_scenario(made.text, as_file, overrides),
          .text = std::move(made.text),
          .assumed = std::move(assumed)};
}

std::vector<std::string> take_warnings(const sim::Simulator& simulator, bool strict) {
  std::vector<std::string> warnings;
  for (const Error& problem : simulator.problems()) {
    if (strict) throw problem;
    warnings.emplace_back(problem.what());
    print_warning(warnings.back());
  }
  return warnings;
}

std::vector<run::Attachment> model_files(const sim::Simulator& simulator) {
  const fs::path folder = simulator.scenario().map_file.parent_path();
  std::vector<run::Attachment> files;
  for (const fs::path& file : simulator.models().files) {
    files.push_back(
        {file.lexically_relative(folder.empty() ? fs::path(".") : folder).generic_string(), read_file(file)});
  }
  return files;
}

}  // namespace hallway::cli
