// SPDX-License-Identifier: MIT
#include "scenario_run.hpp"

#include <fmt/format.h>

#include <memory>

#include "console.hpp"
#include "isolation_options.hpp"
#include "output_file.hpp"
#include "plugin_argument.hpp"
#include "plugin_path.hpp"
#include "renderer_option.hpp"
#include "report.hpp"
#include "run/feed/drive_record.hpp"
#include "run/feed/manifest.hpp"
#include "run/feed/run.hpp"
#include "run/pictures/record.hpp"
#include "run/sources/simulated_source.hpp"
#include "scenario_input.hpp"
#include "shared_options.hpp"
#include "sim/simulator.hpp"

namespace hallway::cli {
namespace {

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

}  // namespace

int run_scenario(const RunOptions& options, Watcher* watcher) {
  const render::Renderer renderer = chosen_renderer(options.renderer);
  OpenedScenario opened =
      open_scenario(options.scenario, overrides_of(options), options.threads, options.strict);
  const sim::Scenario& scenario = opened.simulator->scenario();
  run::SimulatedSource source(*opened.simulator);
  const auto plugin_log = options.foxglove ? std::make_shared<run::PluginLog>() : nullptr;
  const host::LogSink shown_log = watcher != nullptr ? watcher->log_sink() : host::LogSink(print_plugin_log);
  host::Pipeline pipeline = host::Pipeline::unstarted(
      scenario.pipeline, plugin_folders(options.plugin_path), source.activation(),
      plugin_log ? plugin_log->sink(shown_log) : shown_log, isolation_of(options.isolation, scenario.limits));
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
  if (watcher != nullptr) watcher->begin(*opened.simulator, source, manifest);
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
                            {.name = opened.facts.name, .warnings = opened.facts.warnings}, options, watcher);
}

void add_run_options(Command& command, RunOptions& options) {
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
}

}  // namespace hallway::cli
