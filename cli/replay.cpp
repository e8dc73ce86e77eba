// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <thread>

#include "base/error.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "isolation_options.hpp"
#include "log/observations.hpp"
#include "log_import.hpp"
#include "log_input.hpp"
#include "report.hpp"
#include "run/manifest.hpp"
#include "run/paced_source.hpp"
#include "run/record.hpp"
#include "run/run.hpp"
#include "run/tracked_source.hpp"
#include "sim/scenario.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;

struct ReplayOptions {
  std::string observations;
  std::string plugin;
  std::vector<std::string> settings;
  std::uint32_t steps = 0;
  std::string true_poses;
  std::string true_landmarks;
  std::optional<double> period_s;
  std::optional<double> rate;
  std::string out;
  std::vector<std::string> plugin_path;
  IsolationOptions isolation;
  bool ids_as_tracks = false;
  bool foxglove = false;
  bool force = false;
  bool json = false;
  bool quiet = false;
};

/// A parameter that names a file or folder in the log's run.
struct PathLeftOut {
  std::string plugin;
  std::string parameter;
};

/// Stages to build, with where their parameters come from.
struct Stages {
  std::vector<host::StageSpec> specs;
  std::vector<run::ParameterOrigin> origins;
  std::vector<PathLeftOut> paths_left_out{};
};

/// Of a plugin that a log names only the id counts: a log must not make this program load a file of its choice.
void check_recorded_id(const std::string& id) {
  const bool plain = std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  });
  if (plain && !id.empty() && !id.ends_with(".so")) return;
  throw Error(ErrorCode::kBadInput,
              fmt::format("the log names a plugin \"{}\", which is no id", printable(id)),
              {.file = run::files::kRun, .element = "plugins"});
}

/// A log must not choose what a plugin reads and writes either.
bool names_path(const nlohmann::ordered_json& parameter) {
  const std::string type = parameter.value("type", "");
  return type == "file" || type == "folder";
}

/// What the run that wrote the log used, as far as it had been set.
void add_recorded(Stages& stages, const nlohmann::ordered_json& manifest, const std::string& wanted) {
  for (const auto& plugin : manifest.at("plugins")) {
    const std::string id = plugin.at("id").get<std::string>();
    if (wanted.empty()) check_recorded_id(id);
    if (!wanted.empty() && sim::short_plugin_name(wanted) != id) continue;
    host::StageSpec spec{.plugin = wanted.empty() ? id : wanted, .parameters = {}};
    for (const auto& parameter : plugin.at("parameters")) {
      const std::string origin = parameter.at("origin").get<std::string>();
      if (origin == "default" || origin == "sensor") continue;  // the log has what the sensor told
      const std::string name = parameter.at("name").get<std::string>();
      if (names_path(parameter)) {
        stages.paths_left_out.push_back({id, name});
        continue;
      }
      spec.parameters.push_back({name, parameter.at("value").get<std::string>(), {.file = run::files::kRun}});
      stages.origins.push_back({id, name, run::files::kRun});
    }
    stages.specs.push_back(std::move(spec));
  }
}

/// `PLUGIN.parameter=value`, or `parameter=value` where there is one plugin.
void add_setting(Stages& stages, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Error(ErrorCode::kUsage, fmt::format("--set takes parameter=value, not \"{}\"", printable(text)));
  }
  std::string name = text.substr(0, equals);
  host::StageSpec* stage = stages.specs.size() == 1 ? &stages.specs.front() : nullptr;
  if (const std::size_t dot = name.find('.'); dot != std::string::npos) {
    stage = nullptr;
    for (host::StageSpec& candidate : stages.specs) {
      if (sim::short_plugin_name(candidate.plugin) == name.substr(0, dot)) stage = &candidate;
    }
    name = name.substr(dot + 1);
  }
  if (stage == nullptr) {
    throw Error(ErrorCode::kUsage, fmt::format("--set {}: no plugin of that name is run", printable(text)));
  }
  stage->parameters.push_back({name, text.substr(equals + 1), {.file = "--set"}});
  stages.origins.push_back({sim::short_plugin_name(stage->plugin), name, "command line"});
}

Stages stages_of(const ReplayOptions& options, const OpenedLog& input) {
  Stages stages;
  try {
    if (input.manifest) add_recorded(stages, *input.manifest, options.plugin);
  } catch (const nlohmann::json::exception& failure) {
    throw Error(ErrorCode::kBadInput, printable(failure.what()),
                {.file = run::files::kRun, .element = "plugins"});
  }
  if (stages.specs.empty() && options.plugin.empty()) {
    throw Error(ErrorCode::kUsage,
                "--plugin is needed: the log does not stand in a run folder that names one");
  }
  if (stages.specs.empty()) stages.specs.push_back({.plugin = options.plugin, .parameters = {}});
  for (const std::string& setting : options.settings) add_setting(stages, setting);
  return stages;
}

/// Of each path that was left out and not given by --set.
std::vector<std::string> warnings_of(const Stages& stages) {
  std::vector<std::string> warnings;
  for (const PathLeftOut& path : stages.paths_left_out) {
    const bool is_given = std::ranges::any_of(stages.origins, [&](const run::ParameterOrigin& origin) {
      return origin.plugin == path.plugin && origin.name == path.parameter;
    });
    if (is_given) continue;
    warnings.push_back(fmt::format(
        "{}.{} named a file or folder in the run that wrote the log; it is not taken: give it by --set",
        printable(path.plugin), printable(path.parameter)));
  }
  return warnings;
}

/// A log of our own, or a recording of other programs read as `hallway log convert` reads it.
OpenedLog open_input(const ReplayOptions& options) {
  const LogChoice choice{.log = options.observations,
                         .true_poses = options.true_poses,
                         .true_landmarks = options.true_landmarks,
                         .period_s = options.period_s,
                         .steps = options.steps};
  const auto kind = import::tell_kind(options.observations);
  if (!kind) return open_log(choice);
  check_import_options(kind, choice, {});
  return open_recording(*kind, choice, {});
}

int replay(const ReplayOptions& options) {
  OpenedLog input = open_input(options);
  if (options.ids_as_tracks) {
    input.source = std::make_unique<run::TrackedSource>(std::move(input.source));
    input.warnings.push_back("the plugins were told which landmark each point is (--ids-as-tracks)");
    print_warning(input.warnings.back());
  }
  std::optional<run::PacedSource> paced;
  if (options.rate) {
    paced.emplace(*input.source, *options.rate,
                  [](run::PacedSource::Clock::time_point due) { std::this_thread::sleep_until(due); });
  }
  run::Source& source = paced ? *paced : *input.source;
  Stages stages = stages_of(options, input);
  for (const std::string& warning : warnings_of(stages)) {
    print_warning(warning);
    input.warnings.push_back(warning);
  }
  const std::vector<host::SensorInfo> sensors{source.sensor()};
  const sim::PluginLimits limits = apply(options.isolation, {});
  const auto plugin_log = options.foxglove ? std::make_shared<run::PluginLog>() : nullptr;
  host::Pipeline pipeline =
      host::Pipeline::unstarted(stages.specs, plugin_folders(options.plugin_path), sensors,
                                plugin_log ? plugin_log->sink(print_plugin_log) : print_plugin_log,
                                isolation_of(options.isolation, limits));
  std::vector<record::Failure> start_failures = record::start_plugins(pipeline, limits.on_failure);
  const run::ManifestFacts facts{.command = "replay",
                                 .name = input.name,
                                 .inputs = std::move(input.inputs),
                                 .parameters = std::move(stages.origins),
                                 .warnings = input.warnings,
                                 .period_ns = input.period_ns};
  const run::RunPlan plan{
      .folder = options.out.empty() ? fs::path("out") / ("replay-" + input.name) : fs::path(options.out),
      .replace = options.force,
      .manifest = run::make_manifest(facts, pipeline),
      .attachments = {},
      .pictures = {},
      .write_observations = false,
      // At their own pace frames would be waited for while answers are there; what a plugin logs belongs to its frame.
      .lock_step = options.rate.has_value() || options.foxglove,
      .on_failure = limits.on_failure,
      .start_failures = std::move(start_failures),
      .foxglove = plugin_log};
  return execute_and_report(source, pipeline, plan, {.name = input.name, .warnings = input.warnings},
                            {.json = options.json, .quiet = options.quiet});
}

}  // namespace

void add_replay_command(CLI::App& app, Action& chosen) {
  CLI::App* command =
      app.add_subcommand("replay", "Feed recorded observations to a plugin, and measure what it maps");
  const auto options = std::make_shared<ReplayOptions>();
  command
      ->add_option(
          "observations", options->observations,
          "CSV file with the columns iteration,x,y,z and perhaps landmark_id (for scoring only), or of "
          "observed planes, an .mcap log, "
          "or a run folder; an .mcap log, and a CSV file in a run folder, bring the run's plugin, "
          "parameters and "
          "truth with them")
      ->required()
      ->type_name("LOG");
  command->add_option("--plugin", options->plugin, "Plugin to run: an id or a .so file")
      ->type_name("NAME|FILE");
  command
      ->add_option(
          "--set", options->settings,
          "Set a plugin's parameter (noise_m=0.1, or slam_point.noise_m=0.1); may be given several times")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->expected(1);
  command->add_option("--steps", options->steps, "Number of iterations [all]")
      ->type_name("N")
      ->check(CLI::Range(1u, log::kMaxIteration));
  command
      ->add_option("--truth-poses", options->true_poses,
                   "CSV file with the columns iteration,x,y,z and perhaps qw,qx,qy,qz")
      ->type_name("FILE");
  command
      ->add_option("--truth-landmarks", options->true_landmarks,
                   "CSV file with the columns landmark_id,x,y,z")
      ->type_name("FILE");
  command->add_option("--period", options->period_s, "Seconds from frame to frame [the run's, else 0.1]")
      ->type_name("S")
      ->check(CLI::Range(1e-6, 1e6));
  command
      ->add_option(
          "--rate", options->rate,
          "Feed frames at their own pace: 1 as recorded, 2 twice as fast [as fast as the plugin answers]")
      ->type_name("X")
      ->check(CLI::Range(1e-3, 1e3));
  command->add_flag("--ids-as-tracks", options->ids_as_tracks,
                    "Give plugins the true landmark of each point as the sensor's track of it, for those "
                    "that need to be told");
  command->add_option("--out", options->out, "Folder to write [out/replay-<name>]")->type_name("DIR");
  add_plugin_path_option(*command, options->plugin_path);
  add_isolation_options(*command, options->isolation);
  command->add_flag("--foxglove", options->foxglove,
                    "Add channels to run.mcap that show the run in Foxglove");
  command->add_flag("--force", options->force, "Replace an earlier run in the output folder");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->add_flag("--quiet", options->quiet, "Print no progress and no table");
  command->footer("Example: hallway replay out/office/run.mcap --plugin ./my_slam.so --out out/mine");
  command->callback([&chosen, options] { chosen = [options] { return replay(*options); }; });
}

}  // namespace hallway::cli
