// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <set>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "log/landmarks.hpp"
#include "log/observations.hpp"
#include "log/poses.hpp"
#include "report.hpp"
#include "run/log_source.hpp"
#include "run/manifest.hpp"
#include "run/record.hpp"
#include "run/run.hpp"
#include "run/sensor_json.hpp"
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
  std::string out;
  std::vector<std::string> plugin_path;
  bool force = false;
  bool json = false;
  bool quiet = false;
};

constexpr double kDefaultPeriod_s = 0.1;

/// The log and what stands beside it: a log in a run folder brings the run's facts with it.
struct Input {
  fs::path observations;
  std::optional<nlohmann::ordered_json> manifest;  ///< run.json of its folder
  std::optional<fs::path> true_poses;
  std::optional<fs::path> true_landmarks;
  std::string name;
};

std::optional<fs::path> if_there(const fs::path& path) {
  std::error_code code;
  return fs::exists(path, code) ? std::optional(path) : std::nullopt;
}

Input find_input(const ReplayOptions& options) {
  Input input;
  std::error_code code;
  input.observations = options.observations;
  if (fs::is_directory(input.observations, code)) input.observations /= run::files::kObservations;
  const fs::path folder = input.observations.parent_path();
  if (input.observations.filename() == run::files::kObservations && run::is_run_folder(folder)) {
    input.manifest = run::read_manifest(folder);
    input.name = input.manifest->value("name", "log");
    input.true_poses = if_there(folder / run::files::kTruePoses);
    input.true_landmarks = if_there(folder / run::files::kTrueLandmarks);
  } else {
    // A log is often called obs.csv: the folder says more.
    const fs::path absolute = fs::absolute(input.observations, code);
    input.name = absolute.parent_path().filename().string();
    if (input.name.empty()) input.name = absolute.stem().string();
  }
  if (!options.true_poses.empty()) input.true_poses = options.true_poses;
  if (!options.true_landmarks.empty()) input.true_landmarks = options.true_landmarks;
  return input;
}

std::int64_t period_of(const ReplayOptions& options, const Input& input) {
  if (options.period_s) return static_cast<std::int64_t>(*options.period_s * 1e9 + 0.5);
  if (input.manifest && input.manifest->contains("period_ns")) {
    return input.manifest->at("period_ns").get<std::int64_t>();
  }
  return static_cast<std::int64_t>(kDefaultPeriod_s * 1e9);
}

host::SensorInfo sensor_of(const Input& input) {
  if (input.manifest && input.manifest->contains("sensors") && !input.manifest->at("sensors").empty()) {
    return run::read_sensor(input.manifest->at("sensors").front());
  }
  host::SensorInfo sensor;
  sensor.name = "log";
  return sensor;
}

/// Stages to build, with where their parameters come from.
struct Stages {
  std::vector<host::StageSpec> specs;
  std::vector<run::ParameterOrigin> origins;
};

/// What the run that wrote the log used, as far as it had been set.
void add_recorded(Stages& stages, const nlohmann::ordered_json& manifest, const std::string& wanted) {
  for (const auto& plugin : manifest.at("plugins")) {
    const std::string id = plugin.at("id").get<std::string>();
    if (!wanted.empty() && sim::short_plugin_name(wanted) != id) continue;
    host::StageSpec spec{.plugin = wanted.empty() ? id : wanted, .parameters = {}};
    for (const auto& parameter : plugin.at("parameters")) {
      if (parameter.at("origin").get<std::string>() == "default") continue;
      const std::string name = parameter.at("name").get<std::string>();
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

Stages stages_of(const ReplayOptions& options, const Input& input) {
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

int replay(const ReplayOptions& options) {
  const Input input = find_input(options);
  run::ManifestFacts facts{.command = "replay", .name = input.name, .period_ns = period_of(options, input)};
  const auto read_input = [&](const fs::path& path) -> const std::string& {
    facts.inputs.push_back({path.filename().string(), read_file(path)});
    return facts.inputs.back().content;
  };
  facts.inputs.reserve(3);  // the texts that read_input() gives stay where they are
  log::ReadLog read = log::parse_observations(read_input(input.observations), input.observations.string());
  if (read.damage) {
    facts.warnings.push_back(log::describe(*read.damage, read.log, input.observations.string()));
    print_warning(facts.warnings.back());
  }
  run::LogTruth truth;
  if (input.true_poses)
    truth.poses = log::parse_poses(read_input(*input.true_poses), input.true_poses->string());
  if (input.true_landmarks) {
    truth.landmarks = log::parse_landmarks(read_input(*input.true_landmarks), input.true_landmarks->string());
  }
  run::LogSource source(std::move(read.log), std::move(truth), sensor_of(input), facts.period_ns,
                        options.steps);
  Stages stages = stages_of(options, input);
  const std::vector<host::SensorInfo> sensors{source.sensor()};
  host::Pipeline pipeline(stages.specs, plugin_folders(options.plugin_path), sensors, print_plugin_log);
  facts.parameters = std::move(stages.origins);
  const run::RunPlan plan{
      .folder = options.out.empty() ? fs::path("out") / ("replay-" + input.name) : fs::path(options.out),
      .replace = options.force,
      .manifest = run::make_manifest(facts, pipeline),
      .attachments = {},
      .pictures = {},
      .write_observations = false};
  return execute_and_report(source, pipeline, plan, {.name = input.name, .warnings = facts.warnings},
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
          "CSV file with the columns iteration,x,y,z and perhaps landmark_id (for scoring only), or a run "
          "folder; a log in a run folder brings the run's plugin, parameters and truth with it")
      ->required()
      ->type_name("OBSERVATIONS");
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
  command->add_option("--out", options->out, "Folder to write [out/replay-<name>]")->type_name("DIR");
  add_plugin_path_option(*command, options->plugin_path);
  command->add_flag("--force", options->force, "Replace an earlier run in the output folder");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->add_flag("--quiet", options->quiet, "Print no progress and no table");
  command->footer("Example: hallway replay out/office/observations.csv --plugin ./my_slam.so --out out/mine");
  command->callback([&chosen, options] { chosen = [options] { return replay(*options); }; });
}

}  // namespace hallway::cli
