// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "map/document.hpp"
#include "sim/scenario.hpp"

namespace hallway::sim {

/// What a map does not say, and a scenario for it says.
struct Assumption {
  std::string text{};                 ///< a sentence
  std::vector<std::string> unless{};  ///< settings that make it untrue
};

/// A scenario for a map that has none.
struct DefaultScenario {
  std::string text{};  ///< TOML, whose comments say why each value is what it is
  std::vector<Assumption> assumed{};
};

/// Makes one: the robot follows the map's path once, or stays at its start where it has no path; with the map's sensors, or one of points; the
/// plugin for them: `slam_point` where one is of points, else `slam_plane` for planes and faces, `icp` for a lidar, `dead_reckoning` for encoders and odometry, else none; and a picture. Throws Error{kBadInput} for a map with neither a
/// path nor a start, and for one that find_path() or map::sensors() refuse.
/// @param map_file  as the scenario is to name it
DefaultScenario default_scenario(const map::Document& document, const std::string& map_file);

/// load_scenario() of a text that is not in a file. @param file  that it counts as: names in it are seen from its folder
Scenario parse_scenario(const std::string& text, const std::filesystem::path& file,
                        std::span<const Override> overrides = {});

}  // namespace hallway::sim
