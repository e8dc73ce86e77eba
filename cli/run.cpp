// SPDX-License-Identifier: MIT
#include "run/run.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "isolation_options.hpp"
#include "plugin_argument.hpp"
#include "renderer_option.hpp"
#include "report.hpp"
#include "run/manifest.hpp"
#include "run/record.hpp"
#include "run/simulated_source.hpp"
#include "scenario_input.hpp"
#include "shared_options.hpp"
#include "sim/simulator.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;

struct RunOptions {
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
  bool force = false;
  bool json = false;
  bool quiet = false;
};

std::vector<sim::Override> overrides_of(const RunOptions& options) {
  std::vector<sim::Override> overrides;
  if (!options.plugin.empty()) {
    refuse_second_values(options.plugin, options.settings);
    overrides = plugin_overrides(options.plugin);
  }
  for (const std::string& setting : options.settings) overrides.push_back(parse_setting(setting));
  if (options.seed) overrides.push_back({"seed", fmt::to_string(*options.seed)});
  if (options.steps) overrides.push_back({"steps", fmt::to_string(*options.steps)});
  for (const sim::Override& limit : overrides_of(options.isolation)) overrides.push_back(limit);
  return overrides;
}

int run_scenario(const RunOptions& options) {
  const render::Renderer renderer = chosen_renderer(options.renderer);
  const ScenarioInput read = read_scenario_input(options.scenario, overrides_of(options));
  const sim::Scenario& scenario = read.scenario;
  const sim::Simulator simulator(scenario, options.threads, trace::Backend::kEmbree);
  const std::vector<std::string> warnings = take_warnings(simulator, options.strict);
  run::SimulatedSource source(simulator);
  const std::vector<host::SensorInfo> sensors{source.sensor()};
  const auto plugin_log = options.foxglove ? std::make_shared<run::PluginLog>() : nullptr;
  host::Pipeline pipeline =
      host::Pipeline::unstarted(scenario.pipeline, plugin_folders(options.plugin_path), sensors,
                                plugin_log ? plugin_log->sink(print_plugin_log) : print_plugin_log,
                                isolation_of(options.isolation, scenario.limits));
  std::vector<record::Failure> start_failures = record::start_plugins(pipeline, scenario.limits.on_failure);
  if (run::maps_planes(pipeline)) source.add_walls();

  const std::string name = fs::path(scenario.file).stem().string();
  run::ManifestFacts facts{.command = "run",
                           .name = name,
                           .settings = simulator.scenario().settings,
                           .parameters = record::origins_of(scenario.pipeline),
                           .warnings = warnings,
                           .period_ns = scenario.period_ns,
                           .threads = options.threads};
  facts.inputs = {{fs::path(scenario.file).filename().string(), read.text},
                  {scenario.map_file.filename().string(), read_file(scenario.map_file)}};
  const std::vector<run::Attachment> models = model_files(simulator);
  facts.inputs.insert(facts.inputs.end(), models.begin(), models.end());
  run::RunPlan plan{.folder = options.out.empty() ? fs::path("out") / name : fs::path(options.out),
                    .replace = options.force,
                    .manifest = run::make_manifest(facts, pipeline),
                    .attachments = {{run::files::kScenario, facts.inputs[0].content},
                                    {run::files::kMap, facts.inputs[1].content}},
                    .pictures = scenario.pictures,
                    .renderer = renderer,
                    .write_observations = true,
                    .lock_step = true,
                    .on_failure = scenario.limits.on_failure,
                    .start_failures = std::move(start_failures),
                    .foxglove = plugin_log};
  for (const run::Attachment& model : models) plan.attachments.push_back(model);
  return execute_and_report(source, pipeline, plan, {.name = name, .warnings = warnings},
                            {.json = options.json, .quiet = options.quiet});
}

}  // namespace

void add_run_command(Command& app) {
  Command& command = app.command(
      "run", "Drive a simulated robot through a map, run a plugin on what it observes, and score its map");
  const auto options = std::make_shared<RunOptions>();
  command
      .argument("scenario", &options->scenario,
                "Scenario file: map, robot, sensors, plugins, pictures; or a .map file, for which a scenario "
                "is made")
      .required()
      .value("SCENARIO|MAP");
  add_shared(command, Shared::kOutFolder, &options->out).fallback("out/<scenario>");
  add_shared(command, Shared::kSeed, &options->seed).fallback("the scenario's");
  add_shared(command, Shared::kSteps, &options->steps).fallback("the scenario's");
  add_shared(command, Shared::kSet, &options->settings).repeatable();
  add_shared(command, Shared::kPlugin, &options->plugin).fallback("the scenario's");
  add_plugin_path_option(command, options->plugin_path);
  add_shared(command, Shared::kThreads, &options->threads).fallback("all processors");
  add_isolation_options(command, options->isolation);
  add_renderer_option(command, options->renderer);
  add_shared(command, Shared::kStrict, &options->strict);
  add_shared(command, Shared::kFoxglove, &options->foxglove);
  add_shared(command, Shared::kForce, &options->force);
  add_shared(command, Shared::kJson, &options->json);
  add_shared(command, Shared::kQuiet, &options->quiet);
  command.footer(
      "Without a renderer everything is written but the pictures of maps, which a warning and the JSON "
      "document name; the status is that of the run. A renderer that is named has to be there.\n"
      "Example: hallway run maps/office.toml --seed 7 --set sensor.eyes.noise_m=0.02 --out out/noisy");
  command.action([options] { return run_scenario(*options); });
}

}  // namespace hallway::cli
