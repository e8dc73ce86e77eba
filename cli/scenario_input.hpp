// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "run/run.hpp"
#include "sim/simulator.hpp"

namespace hallway::cli {

/// A scenario, and the text that it was read from.
struct ScenarioInput {
  sim::Scenario scenario{};
  std::string text{};
  std::vector<std::string> assumed{};  ///< of a map that has no scenario: what it does not say
};

/// Reads a scenario file, or makes a scenario for a `.map` file and prints what it assumes. Throws what sim::load_scenario() throws.
ScenarioInput read_scenario_input(const std::string& file, std::span<const Override> overrides);

/// What the user should know of the map, printed too. Throws the first of it if `strict`.
std::vector<std::string> take_warnings(const sim::Simulator& simulator, bool strict);

/// The files of the map's models, named as the map names them.
std::vector<run::Attachment> model_files(const sim::Simulator& simulator);

}  // namespace hallway::cli
