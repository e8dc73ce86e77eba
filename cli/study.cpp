// SPDX-License-Identifier: MIT
#include "study/study.hpp"
#include "base/refuse.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <set>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "bin_points.hpp"
#include "command.hpp"
#include "console.hpp"
#include "host/plugin_table.hpp"
#include "isolation_options.hpp"
#include "maps_folder.hpp"
#include "output_file.hpp"
#include "plugin_argument.hpp"
#include "plugin_report.hpp"
#include "plugin_sweep.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

struct StudyOptions : OutputOptions {
  std::vector<std::string> plugins;
  std::vector<std::string> settings;
  std::vector<std::string> plugin_path;
  std::uint32_t seeds = 5;
  std::uint32_t steps = 0;
  bool quick = false;
  std::string out;
  std::string maps;
  std::string data;
  unsigned threads = hardware_threads();
  IsolationOptions isolation;
};

/// Every combination of the values that a sweep has.
std::vector<study::PluginChoice> choices_of(const batch::PluginSweep& sweep) {
  std::vector<study::PluginChoice> choices{{.plugin = sweep.plugin}};
  for (const auto& parameter : sweep.parameters) {
    std::vector<study::PluginChoice> more;
    for (const study::PluginChoice& choice : choices) {
      for (const std::string& value : parameter.values) {
        more.push_back(choice);
        more.back().parameters.emplace_back(parameter.name, value);
      }
    }
    choices = std::move(more);
  }
  return choices;
}

/// Gives the parameters of --set to the plugins that they are of.
void set_parameters(const StudyOptions& options, std::vector<study::PluginChoice>& choices) {
  for (const std::string& plugin : options.plugins) refuse_second_values(plugin, options.settings);
  for (const std::string& text : options.settings) {
    const Override setting = parse_setting(text);
    const std::size_t dot = setting.key.rfind('.');
    const std::string wanted = dot == std::string::npos ? "" : setting.key.substr(0, dot);
    std::set<std::string> names;
    for (const study::PluginChoice& choice : choices) names.insert(host::short_plugin_name(choice.plugin));
    if (wanted.empty() && names.size() > 1) refuse_whose(setting, {names.begin(), names.end()});
    bool found = false;
    for (study::PluginChoice& choice : choices) {
      if (!wanted.empty() && host::short_plugin_name(choice.plugin) != wanted) continue;
      choice.parameters.emplace_back(setting.key.substr(dot + 1), setting.value);
      found = true;
    }
    if (!found)
      refuse("--set {}: no plugin \"{}\" runs{}", printable(text), printable(wanted),
             suggestion(wanted, {names.begin(), names.end()}));
  }
}

study::Request request_of(const study::Study& study, const StudyOptions& options) {
  study::Request request{.seeds = options.quick ? std::min(options.seeds, 2u) : options.seeds,
                         .quick = options.quick,
                         .steps = options.steps,
                         .bin_points = slam_point_binning()};
  for (const std::string& plugin : options.plugins) {
    for (study::PluginChoice& choice : choices_of(parse_plugin_sweep(plugin)))
      request.plugins.push_back(std::move(choice));
  }
  if (request.plugins.empty()) request.plugins = study::default_plugins(study);
  set_parameters(options, request.plugins);
  return request;
}

fs::path data_folder(const StudyOptions& options) {
  if (!options.data.empty()) return options.data;
  const char* named = std::getenv("HALLWAY_DATA");
  return named != nullptr ? fs::path(named) : maps_folder(options.maps).parent_path() / "data";
}

std::uint64_t iterations_of(const std::vector<study::RunSpec>& specs) {
  std::uint64_t sum = 0;
  for (const study::RunSpec& spec : specs) sum += spec.iterations();
  return sum;
}

std::string summary(const study::Outcome& outcome, const fs::path& folder) {
  std::string text;
  for (const study::Table& table : outcome.tables) {
    if (table.file == "findings" || table.file == "times_findings") text += print_text(table) + "\n";
  }
  for (const study::Chart& chart : outcome.charts)
    text += fmt::format("figure {:<16} {}\n", chart.figures,
                        printable((folder / (chart.file + ".svg")).string(), 4096));
  return text + fmt::format("written to {}\n", path_text(folder));
}

/// One line for each run in which a plugin failed.
bool report_plugin_failures(const std::vector<study::StudyRun>& runs) {
  bool any = false;
  for (const study::StudyRun& run : runs) {
    if (run.trace.failure.empty()) continue;
    any = true;
    print_warning("{}, seed {}: {}", run.spec.group(), run.spec.seed, printable(run.trace.failure, 500));
  }
  return any;
}

int run_study(const study::Study& study, const StudyOptions& options) {
  const fs::path folder = output_folder(options.out, "study-" + std::string(study.name));
  check_output_folder(folder, "study.json", options.force);
  const study::Request request = request_of(study, options);
  const std::vector<study::RunSpec> specs = study.plan(request);
  catch_interrupts();
  Progress progress("iterations", iterations_of(specs), options.quiet || options.json);
  const std::vector<study::StudyRun> runs =
      study::make_runs(specs, {.folders = {.maps = maps_folder(options.maps), .out = folder},
                               .data = data_folder(options),
                               .threads = options.threads,
                               .plugin_folders = plugin_folders(options.plugin_path),
                               .isolation = isolation_of(options.isolation, apply(options.isolation, {})),
                               .log = print_plugin_log,
                               .progress = [&](std::uint64_t done) { progress.update(done); },
                               .stop = interrupted});
  if (interrupted()) throw Error(ErrorCode::kInterrupted, "interrupted");
  study::Outcome outcome = study.conclude(runs, request);
  for (study::Table& table : study::common_tables(runs)) outcome.tables.push_back(std::move(table));
  Json document = study::write_outcome(study, request, outcome, folder);
  if (options.json) {
    document["folder"] = path_text(folder);
    print_json(document);
  } else if (!options.quiet) {
    print_result(summary(outcome, folder));
  }
  return report_plugin_failures(runs) ? exit_status(ErrorCode::kPluginFault) : 0;
}

/// What runs without --plugin, for help.
std::string default_plugins_text(const study::Study& study) {
  std::vector<std::string> labels;
  for (const study::PluginChoice& choice : study::default_plugins(study)) {
    if (choice.parameters.size() > 1) return "slam_point, with parameters for these data";
    labels.push_back(choice.label());
  }
  return fmt::format("{}", fmt::join(labels, ", and "));
}

void add_options(const study::Study& study, Command& command, StudyOptions& options) {
  add_shared(command, Shared::kPlugin, &options.plugins).repeatable().fallback(default_plugins_text(study));
  add_shared(command, Shared::kSetPlugin, &options.settings).repeatable();
  add_plugin_path_option(command, options.plugin_path);
  command
      .option("--seeds", &options.seeds,
              "How many seeds, from 1: each has other noise and other landmarks; curves are medians")
      .value("N")
      .range(1u, 1000u)
      .show_default();
  add_shared(command, Shared::kSteps, &options.steps).fallback("the study's");
  command.flag("--quick", &options.quick, "A small size for trying out");
  add_shared(command, Shared::kOutFolder, &options.out).fallback("out/study-<name>");
  add_maps_option(command, options.maps);
  command.option("--data", &options.data, "Folder of recorded data [$HALLWAY_DATA]").value("DIR");
  add_shared(command, Shared::kThreads, &options.threads).fallback("all processors");
  add_limit_options(command, options.isolation);
  add_output_options(command, options);
}

}  // namespace

void add_study_command(Command& app) {
  Command& group =
      app.command("study", "Repeat an evaluation of the thesis with any plugin: tables, findings and charts");
  group.footer("Example: hallway study straight --plugin slam_point --plugin ./my_slam.so --seeds 3");
  for (const study::Study& study : study::studies()) {
    Command& command = group.command(std::string(study.name), std::string(study.about));
    const auto options = std::make_shared<StudyOptions>();
    add_options(study, command, *options);
    command.footer(
        fmt::format("Full size: {}. Corresponds to the thesis's figures {}.\n"
                    "Writes findings.csv, runs.csv, curves.csv, charts as SVG and PNG, and all of it as "
                    "study.json; facts "
                    "of the clock are in times*.csv.\n"
                    "Exit status: 0 done; 5 a plugin failed in a run, the others count.\n"
                    "Example: hallway study {} --seeds 3 --out out/{}",
                    study.size, study.figures, study.name, study.name));
    command.action([&study, options] { return run_study(study, *options); });
  }
  add_first_robot_command(group);
  add_sonar_rooms_command(group);
}

}  // namespace hallway::cli
