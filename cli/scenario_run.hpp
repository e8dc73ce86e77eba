// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "command_line.hpp"
#include "console.hpp"
#include "isolation_options.hpp"
#include "scenario_input.hpp"
#include "watcher.hpp"

namespace hallway::cli {

/// What `run`, and `watch` of a scenario, are asked for.
struct RunOptions : OutputOptions {
  std::string scenario;
  std::string out;
  std::vector<std::string> settings;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint32_t> steps;
  std::string plugin;
  std::vector<std::string> plugin_path;
  unsigned threads = hardware_threads();
  IsolationOptions isolation;
  std::optional<std::string> renderer;
  bool strict = false;
  bool foxglove = false;
};

/// Adds all of them but the scenario.
void add_run_options(Command& command, RunOptions& options);

/// Runs a scenario, writes its folder and prints how it went.
/// @param watcher  is shown the run while it goes on; null: a progress bar is shown. The folder is the same.
/// @return the exit status
int run_scenario(const RunOptions& options, Watcher* watcher = nullptr);

}  // namespace hallway::cli
