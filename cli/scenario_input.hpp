// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "run/feed/manifest.hpp"
#include "run/feed/run.hpp"
#include "sim/simulator.hpp"

namespace hallway::cli {

/// A scenario that is about to run.
struct OpenedScenario {
  std::unique_ptr<sim::Simulator> simulator{};
  run::ManifestFacts facts{};                  ///< all but the command and the plugins' parameters
  std::vector<run::Attachment> attachments{};  ///< scenario, map, robot file and models
};

/// Reads a scenario file, or makes a scenario for a `.map` file and prints what it assumes, and loads its map. What the user should know of the
/// map is printed too; with `strict` the first of it is thrown. Throws what sim::load_scenario() and sim::Simulator throw.
OpenedScenario open_scenario(const std::string& file, std::span<const Override> overrides, unsigned threads,
                             bool strict);

/// The values that --seed and --steps give, and those of --set.
std::vector<Override> scenario_overrides(const std::vector<std::string>& settings,
                                         const std::optional<std::uint64_t>& seed,
                                         const std::optional<std::uint32_t>& steps);

}  // namespace hallway::cli
