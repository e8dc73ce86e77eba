// SPDX-License-Identifier: MIT
#include "run/feed/run.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "base/file.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "isolation_options.hpp"
#include "output_file.hpp"
#include "plugin_argument.hpp"
#include "renderer_option.hpp"
#include "report.hpp"
#include "run/feed/drive_record.hpp"
#include "run/feed/manifest.hpp"
#include "run/pictures/record.hpp"
#include "run/sources/simulated_source.hpp"
#include "scenario_input.hpp"
#include "shared_options.hpp"
#include "sim/simulator.hpp"

namespace hallway::cli {
namespace {

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

std::vector<Override> overrides_of(const RunOptions& options) {
  std::vector<Override> overrides;
  if (!options.plugin.empty()) {
    refuse_second_values(options.plugin, options.settings);
    overrides = plugin_overrides(options.plugin);
  }
  for (const auto& more :
       {scenario_overrides(options.settings, options.seed, options.steps), overrides_of(options.isolation)})
    overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

int run_scenario(const RunOptions& options) {
  const render::Renderer renderer = chosen_renderer(options.renderer);
  OpenedScenario opened =
      open_scenario(options.scenario, overrides_of(options), options.threads, options.strict);
  const sim::Scenario& scenario = opened.simulator->scenario();
  run::SimulatedSource source(*opened.simulator);
  const auto plugin_log = options.foxglove ? std::make_shared<run::PluginLog>() : nullptr;
  host::Pipeline pipeline =
      host::Pipeline::unstarted(scenario.pipeline, plugin_folders(options.plugin_path), source.activation(),
                                plugin_log ? plugin_log->sink(print_plugin_log) : print_plugin_log,
                                isolation_of(options.isolation, scenario.limits));
  std::vector<record::Failure> start_failures = record::start_plugins(pipeline, scenario.limits.on_failure);
  if (run::maps_planes(pipeline)) source.add_walls();
  opened.facts.command = "run";
  opened.facts.parameters = record::origins_of(scenario.pipeline);
  nlohmann::ordered_json manifest = run::make_manifest(opened.facts, pipeline);
  if (const auto& driven = scenario.robot.driven) {
    manifest["robot"] = run::print_driven(scenario);
    if (driven->by == sim::DrivenBy::kPlugin && pipeline.started())
      pipeline.drive_by(run::driving_plugin(pipeline, scenario));
  }
  const run::RunPlan plan{.folder = output_folder(options.out, opened.facts.name),
                          .replace = options.force,
                          .manifest = std::move(manifest),
                          .attachments = std::move(opened.attachments),
                          .pictures = scenario.pictures,
                          .renderer = renderer,
                          .write_observations = true,
                          .lock_step = true,
                          .on_failure = scenario.limits.on_failure,
                          .start_failures = std::move(start_failures),
                          .foxglove = plugin_log};
  return execute_and_report(source, pipeline, plan,
                            {.name = opened.facts.name, .warnings = opened.facts.warnings}, options);
}

}  // namespace

void add_run_command(Command& app) {
  Command& command = app.command(
      "run", "Drive a simulated robot through a map, run a plugin on what it observes, and score its map");
  RunOptions& options = command.runs(&run_scenario);
  command
      .argument("scenario", &options.scenario,
                "Scenario file: map, robot, sensors, plugins, pictures; or a .map file, for which a scenario "
                "is made")
      .required()
      .value("SCENARIO|MAP");
  add_shared(command, Shared::kOutFolder, &options.out).fallback("out/<scenario>");
  add_shared(command, Shared::kSeed, &options.seed).fallback("the scenario's");
  add_shared(command, Shared::kSteps, &options.steps).fallback("the scenario's");
  add_shared(command, Shared::kSet, &options.settings).repeatable();
  add_shared(command, Shared::kPlugin, &options.plugin).fallback("the scenario's");
  add_plugin_path_option(command, options.plugin_path);
  add_shared(command, Shared::kThreads, &options.threads).fallback("all processors");
  add_isolation_options(command, options.isolation);
  add_renderer_option(command, options.renderer);
  add_shared(command, Shared::kStrict, &options.strict);
  add_shared(command, Shared::kFoxglove, &options.foxglove);
  add_output_options(command, options);
  command.footer(
      "Without a renderer everything is written but the pictures of maps, which a warning and the JSON "
      "document name; the status is that of the run. A renderer that is named has to be there.\n"
      "Example: hallway run maps/office.toml --seed 7 --set sensor.eyes.noise_m=0.02 --out out/noisy");
}

}  // namespace hallway::cli
