// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "scenario_run.hpp"

namespace hallway::cli {

namespace {

int run_unwatched(const RunOptions& options) {
  return run_scenario(options);
}

}  // namespace

void add_run_command(Command& app) {
  Command& command = app.command(
      "run", "Drive a simulated robot through a map, run a plugin on what it observes, and score its map");
  RunOptions& options = command.runs(&run_unwatched);
  command
      .argument("scenario", &options.scenario,
                "Scenario file: map, robot, sensors, plugins, pictures; or a .map file, for which a scenario "
                "is made")
      .required()
      .value("SCENARIO|MAP");
  add_run_options(command, options);
  command.footer(
      "Without a renderer everything is written but the pictures of maps, which a warning and the JSON "
      "document name; the status is that of the run. A renderer that is named has to be there.\n"
      "Example: hallway run maps/office.toml --seed 7 --set sensor.eyes.noise_m=0.02 --out out/noisy");
}

}  // namespace hallway::cli
