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
#include "renderer_option.hpp"
#include "report.hpp"
#include "run/manifest.hpp"
#include "run/record.hpp"
#include "run/simulated_source.hpp"
#include "scenario_input.hpp"
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
  if (!options.plugin.empty()) overrides.push_back({"plugin", options.plugin});
  for (const std::string& setting : options.settings) overrides.push_back(parse_setting(setting));
  if (options.seed) overrides.push_back({"seed", fmt::to_string(*options.seed)});
  if (options.steps) overrides.push_back({"steps", fmt::to_string(*options.steps)});
  for (const sim::Override& limit : overrides_of(options.isolation)) overrides.push_back(limit);
  return overrides;
}

int run_scenario(const RunOptions& options) {
  const render::Renderer renderer = chosen_renderer(options.renderer);
  const sim::Scenario scenario = sim::load_scenario(options.scenario, overrides_of(options));
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
  facts.inputs = {{fs::path(scenario.file).filename().string(), read_file(scenario.file)},
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

void add_run_command(CLI::App& app, Action& chosen) {
  CLI::App* command = app.add_subcommand(
      "run",
      "Drive a simulated robot through a map, feed what it sees to a plugin, and measure what it maps");
  const auto options = std::make_shared<RunOptions>();
  command->add_option("scenario", options->scenario, "Scenario file: map, robot, sensors, plugins, pictures")
      ->required()
      ->type_name("SCENARIO");
  command->add_option("--out", options->out, "Folder to write [out/<scenario>]")->type_name("DIR");
  command->add_option("--seed", options->seed, "Seed of all random numbers, instead of the scenario's")
      ->type_name("N");
  command->add_option("--steps", options->steps, "Number of iterations, instead of the scenario's")
      ->type_name("N");
  command
      ->add_option(
          "--set", options->settings,
          "Set a scenario value (sensor.eyes.noise_m=0.1) or a plugin's parameter (slam_point.noise_m=0.1); "
          "may be given several times")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->expected(1);
  command
      ->add_option("--plugin", options->plugin,
                   "Run this plugin instead of the scenario's: an id or a .so file")
      ->type_name("NAME|FILE");
  add_plugin_path_option(*command, options->plugin_path);
  command->add_option("--threads", options->threads, "Threads of the simulator; results do not depend on it")
      ->type_name("N")
      ->check(CLI::Range(1u, 1024u));
  add_isolation_options(*command, options->isolation);
  add_renderer_option(*command, options->renderer);
  command->add_flag("--strict", options->strict, "Refuse a map with brushes that are no solids");
  command->add_flag("--foxglove", options->foxglove,
                    "Add channels to run.mcap that show the run in Foxglove");
  command->add_flag("--force", options->force, "Replace an earlier run in the output folder");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->add_flag("--quiet", options->quiet, "Print no progress and no table");
  command->footer(
      "Without a renderer everything is written but the pictures of maps, which a warning and the JSON "
      "document "
      "name; the status is that of the run. A renderer that is named has to be there.\n"
      "Example: hallway run maps/office.toml --seed 7 --set sensor.eyes.noise_m=0.05 --out out/noisy");
  command->callback([&chosen, options] { chosen = [options] { return run_scenario(*options); }; });
}

}  // namespace hallway::cli
