// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planes/score.hpp"

namespace hallway::cli {

/// What one plugin made of one scene.
struct SceneResult {
  std::string scene{};
  std::size_t points = 0;
  double noise = 0.0;  ///< 0 where it is not known
  double ms = 0.0;
  double cpu_ms = 0.0;
  planes::Score score{};
};

/// What one plugin made of all scenes.
struct PluginResult {
  std::string plugin{};  ///< as it was asked for
  std::string id{};
  std::string version{};
  std::vector<SceneResult> scenes{};
};

/// A line for each plugin: how much it found, how exactly, how fast, and what was wrong. Where `known`, the scores of
/// planes::answer_knowing(), is not empty, a second one for the decidable planes alone, and one for these scores.
std::string bench_em_table(const std::vector<PluginResult>& results, const std::vector<planes::Score>& known);

/// The same for programs, with each scene.
nlohmann::ordered_json bench_em_json(const std::vector<PluginResult>& results);

}  // namespace hallway::cli
