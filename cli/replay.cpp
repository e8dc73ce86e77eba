// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <thread>

#include "base/error.hpp"
#include "base/origin.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "isolation_options.hpp"
#include "log/observations.hpp"
#include "log_import.hpp"
#include "log_input.hpp"
#include "output_file.hpp"
#include "plugin_argument.hpp"
#include "report.hpp"
#include "run/feed/drive_record.hpp"
#include "run/feed/manifest.hpp"
#include "run/feed/run.hpp"
#include "run/pictures/record.hpp"
#include "run/sources/paced_source.hpp"
#include "run/sources/tracked_source.hpp"
#include "shared_options.hpp"
#include "sim/scenario.hpp"

namespace hallway::cli {
namespace {

struct ReplayOptions : OutputOptions {
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
  const bool plain = std::ranges::all_of(id, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  });
  if (plain && !id.empty() && !id.ends_with(".so")) return;
  throw Error(ErrorCode::kBadInput,
              fmt::format("the log names a plugin \"{}\", which is no id", printable(id)),
              {.file = run::files::kRun, .element = "plugins"});
}

/// A log must not choose what a plugin reads and writes either.
bool names_path(const Json& parameter) {
  const std::string type = parameter.value("type", "");
  return type == "file" || type == "folder";
}

/// What the run that wrote the log used, as far as it had been set.
void add_recorded(Stages& stages, const Json& manifest, const std::string& wanted) {
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
      // The log may also be wrong about the type.
      spec.parameters.push_back({.name = name,
                                 .value = parameter.at("value").get<std::string>(),
                                 .where = {.file = run::files::kRun},
                                 .may_name_path = false});
      stages.origins.push_back({id, name, run::files::kRun});
    }
    stages.specs.push_back(std::move(spec));
  }
}

void add_setting(Stages& stages, const std::string& text) {
  const auto [stage, name] = set_parameter(stages.specs, text);
  stages.origins.push_back({sim::short_plugin_name(stage->plugin), name, kCommandLine});
}

Stages stages_of(const ReplayOptions& options, const OpenedLog& input) {
  const host::StageSpec wanted = options.plugin.empty() ? host::StageSpec{} : parse_plugin(options.plugin);
  if (!options.plugin.empty()) refuse_second_values(options.plugin, options.settings);
  Stages stages;
  try {
    if (input.manifest) add_recorded(stages, *input.manifest, wanted.plugin);
  } catch (const nlohmann::json::exception& failure) {
    throw Error(ErrorCode::kBadInput, printable(failure.what()),
                {.file = run::files::kRun, .element = "plugins"});
  }
  if (stages.specs.empty() && wanted.plugin.empty()) {
    refuse("--plugin is needed: the log is not in a run folder that names one");
  }
  if (stages.specs.empty()) stages.specs.push_back({.plugin = wanted.plugin, .parameters = {}});
  for (const host::ParameterSetting& parameter : wanted.parameters)
    add_setting(stages, parameter.name + "=" + parameter.value);
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
  check_replaces_no_input(options.out, std::array{options.observations});
  OpenedLog input = open_input(options);
  if (options.ids_as_tracks) {
    input.source = std::make_unique<run::TrackedSource>(std::move(input.source));
    print_warning(input.warnings, "the plugins were given the landmark of each point (--ids-as-tracks)");
  }
  std::optional<run::PacedSource> paced;
  if (options.rate) {
    paced.emplace(*input.source, *options.rate,
                  [](run::PacedSource::Clock::time_point due) { std::this_thread::sleep_until(due); });
  }
  run::Source& source = paced ? *paced : *input.source;
  Stages stages = stages_of(options, input);
  for (const std::string& warning : warnings_of(stages)) print_warning(input.warnings, warning);
  const sim::PluginLimits limits = apply(options.isolation, {});
  const auto plugin_log = options.foxglove ? std::make_shared<run::PluginLog>() : nullptr;
  host::Pipeline pipeline =
      host::Pipeline::unstarted(stages.specs, plugin_folders(options.plugin_path), source.activation(),
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
      .folder = output_folder(options.out, "replay-" + input.name),
      .replace = options.force,
      .manifest = run::make_manifest(facts, pipeline),
      .attachments = {},
      .pictures = {},
      .write_observations = false,
      // At their own pace frames would be waited for while answers are there; what a plugin logs belongs to its frame.
      .lock_step = options.rate.has_value() || options.foxglove,
      .on_failure = limits.on_failure,
      .compare_commands = run::puts_commands(pipeline),
      .start_failures = std::move(start_failures),
      .foxglove = plugin_log};
  return execute_and_report(source, pipeline, plan, {.name = input.name, .warnings = input.warnings},
                            options);
}

}  // namespace

void add_replay_command(Command& app) {
  Command& command = app.command("replay", "Run a plugin on recorded observations, and score its map");
  ReplayOptions& options = command.runs(&replay);
  command
      .argument("observations", &options.observations,
                "CSV file with the columns iteration,x,y,z and perhaps landmark_id (for scoring only), or of "
                "observed planes, an .mcap log, "
                "or a run folder; an .mcap log, and a CSV file in a run folder, bring the run's plugin, "
                "parameters and "
                "truth with them")
      .required()
      .value("LOG");
  add_shared(command, Shared::kPlugin, &options.plugin).fallback("the run's that wrote the log");
  add_shared(command, Shared::kSetPlugin, &options.settings).repeatable();
  add_shared(command, Shared::kSteps, &options.steps).fallback("all");
  add_shared(command, Shared::kTruePoses, &options.true_poses).fallback("those of the log");
  add_shared(command, Shared::kTrueLandmarks, &options.true_landmarks).fallback("those of the log");
  add_shared(command, Shared::kPeriod, &options.period_s).fallback("the run's, else 0.1");
  add_shared(command, Shared::kRate, &options.rate).fallback("as fast as the plugin answers");
  command.flag("--ids-as-tracks", &options.ids_as_tracks,
               "Give plugins the true landmark of each point as the sensor's track of it, for those "
               "that need it");
  add_shared(command, Shared::kOutFolder, &options.out).fallback("out/replay-<name>");
  add_plugin_path_option(command, options.plugin_path);
  add_isolation_options(command, options.isolation, false);
  add_shared(command, Shared::kFoxglove, &options.foxglove);
  add_output_options(command, options);
  command.footer("Example: hallway replay out/office/run.mcap --plugin ./my_slam.so --out out/mine");
}

}  // namespace hallway::cli
