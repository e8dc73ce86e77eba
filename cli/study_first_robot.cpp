// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "batch/redraw.hpp"
#include "batch/runner.hpp"
#include "command.hpp"
#include "console.hpp"
#include "maps_folder.hpp"
#include "output_file.hpp"
#include "shared_options.hpp"
#include "study/first_robot/mapping.hpp"
#include "study/first_robot/office_files.hpp"

namespace hallway::cli {
namespace {

constexpr double kMostOfficeSeed = 9e18;

struct FirstRobotOptions : OutputOptions {
  std::optional<std::uint64_t> office_seed;
  std::string plugin = "wall_follower";
  std::vector<std::string> settings;
  std::uint32_t seeds = 20;
  std::uint64_t first_seed = 1;
  std::uint32_t offices = 100;
  std::optional<std::uint32_t> steps;
  bool quick = false;
  unsigned jobs = 1;
  std::string out;
  std::string maps;
};

int make_office(const FirstRobotOptions& options) {
  const fs::path map = options.out.empty() ? fmt::format("office_{}.map", *options.office_seed) : options.out;
  if (map.extension() != ".map")
    refuse("--out takes a file that ends in .map, not \"{}\"", printable(map.string()));
  for (const fs::path& file : study::office_files(map)) check_new_file(file, options.force);
  const auto files =
      study::write_office(*options.office_seed, map, maps_folder(options.maps) / "robots/first.map");
  std::string text;
  for (const fs::path& file : files) text += "wrote " + path_text(file) + "\n";
  options.print({{"schema", "hallway.office/1"},
                 {"status", 0},
                 {"seed", *options.office_seed},
                 {"files", path_texts(files)}},
                text);
  return 0;
}

study::MappingRequest request_of(const FirstRobotOptions& options, const fs::path& folder) {
  study::MappingRequest request{.seeds = options.quick ? std::min(options.seeds, 1u) : options.seeds,
                                .offices = options.quick ? std::min(options.offices, 1u) : options.offices,
                                .first_seed = options.first_seed,
                                .maps = maps_folder(options.maps),
                                .out = folder,
                                .arguments = {"--plugin", options.plugin},
                                .by_cost = options.plugin == "wall_follower"};
  if (options.steps) {
    request.arguments.emplace_back("--steps");
    request.arguments.push_back(fmt::to_string(*options.steps));
  }
  for (const std::string& setting : options.settings) {
    request.arguments.emplace_back("--set");
    request.arguments.push_back(setting);
  }
  return request;
}

/// Figures 26 to 28 of the thesis: what was mapped in the simulation, the section with one cubicle doubled, and what was mapped of it with faults.
void draw_figures(const batch::Plan& plan, const std::vector<batch::Result>& results,
                  const batch::RunnerSetup& setup) {
  struct Figure {
    const char* file;
    const char* map;
    const char* faults;
    std::vector<std::string> arguments;
  };
  const Figure figures[] = {{"figure_26.png", "cubicles", "no", {"--cut", "1.2"}},
                            {"figure_27.png",
                             "cubicles_changed",
                             "no",
                             {"--cut", "1.2", "--iteration", "0", "--hide", "all", "--show", "map,body"}},
                            {"figure_28.png", "cubicles_changed", "yes", {"--cut", "1.2"}}};
  for (const Figure& figure : figures) {
    const auto cell = std::ranges::find_if(plan.cells, [&](const batch::Cell& one) {
      return one.labels[0].value == figure.map && one.labels[2].value == figure.faults;
    });
    if (cell == plan.cells.end()) continue;
    if (!results[static_cast<std::size_t>(cell - plan.cells.begin())].good()) continue;
    const batch::PictureRequest picture{.name = "figure", .arguments = figure.arguments};
    const std::vector<std::string> failed =
        batch::redraw_pictures({.cells = {*cell}, .pictures = {picture}}, setup, {});
    const fs::path drawn = setup.folder / "cells" / batch::picture_name(*cell, picture);
    std::error_code problem;
    if (failed.empty()) fs::rename(drawn, setup.folder / figure.file, problem);
    if (!failed.empty() || problem) print_warning("{} could not be drawn", figure.file);
  }
}

std::string rates_text(const study::Outcome& outcome, const fs::path& folder) {
  std::string text;
  for (const study::Table& table : outcome.tables) {
    if (table.file == "rates") text += print_text(table) + "\n";
  }
  return text + fmt::format("written to {}\n", path_text(folder));
}

/// One warning for the runs that failed alike. @return exit status: where no run is good that of the first, which says most
int report_failed_runs(const std::vector<batch::Result>& results) {
  std::map<std::string, std::vector<std::string>> runs_by_problem;
  for (const batch::Result& result : results) {
    if (!result.good()) runs_by_problem[result.problem].push_back(result.name);
  }
  for (const auto& [problem, names] : runs_by_problem) {
    const std::string others = names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : "";
    print_warning("{}{}: {}", names.front(), others, problem);
  }
  if (runs_by_problem.empty()) return 0;
  const bool any_good = std::ranges::any_of(results, &batch::Result::good);
  return any_good ? exit_status(ErrorCode::kPluginFault) : results.front().status;
}

int map_offices(const FirstRobotOptions& options) {
  const fs::path folder = output_folder(options.out, "study-first-robot");
  check_output_folder(folder, "study.json", options.force);
  const study::MappingRequest request = request_of(options, folder);
  if (request.seeds == 0 && request.offices == 0) refuse("--runs 0 --offices 0 leave nothing to run");
  const batch::Plan plan = study::plan_mapping(request);
  catch_interrupts();
  Progress progress("runs", plan.cells.size(), options.quiet || options.json);
  const batch::RunnerSetup setup{.program = fs::read_symlink("/proc/self/exe"),
                                 .folder = folder,
                                 .jobs = options.jobs,
                                 .replace = options.force,
                                 .progress = [&](std::size_t done) { progress.update(done); },
                                 .stop = interrupted};
  const std::vector<batch::Result> results = batch::run_cells(plan, setup);
  if (results.size() < plan.cells.size()) throw Error(ErrorCode::kInterrupted, "interrupted");
  std::vector<study::MappingRun> runs;
  for (const batch::Result& result : results)
    runs.push_back(study::read_mapping_run(result, folder / "cells" / result.name));
  draw_figures(plan, results, setup);
  const study::Outcome outcome = study::conclude_mapping(runs);
  Json document = study::write_outcome(
      study::first_robot_study(),
      {.plugins = {{.plugin = options.plugin}}, .seeds = request.seeds, .quick = options.quick}, outcome,
      folder);
  document["folder"] = path_text(folder);
  options.print(document, rates_text(outcome, folder));
  return report_failed_runs(results);
}

int run_first_robot(const FirstRobotOptions& options) {
  return options.office_seed ? make_office(options) : map_offices(options);
}

}  // namespace

void add_first_robot_command(Command& group) {
  Command& command = group.command("first-robot", std::string(study::first_robot_study().about));
  FirstRobotOptions& options = command.runs(&run_first_robot);
  command
      .option("--make-office", &options.office_seed,
              "Only write an office with this seed: a block of cubicles, a hallway round it, cubicles on its "
              "other side")
      .value("SEED")
      .range(0u, kMostOfficeSeed);
  add_shared(command, Shared::kPlugin, &options.plugin).show_default();
  add_shared(command, Shared::kSetPlugin, &options.settings).repeatable();
  command.option("--runs", &options.seeds, "Runs on each named map, with faults and without each")
      .value("N")
      .range(0u, 10'000u)
      .show_default();
  add_shared(command, Shared::kFirstSeed, &options.first_seed).show_default();
  command.option("--offices", &options.offices, "Generated offices; each is mapped with faults and without")
      .value("N")
      .range(0u, 10'000u)
      .show_default();
  add_shared(command, Shared::kSteps, &options.steps).fallback("the scenarios', 32000");
  command.flag("--quick", &options.quick, "A small size for trying out");
  add_shared(command, Shared::kJobs, &options.jobs).show_default();
  add_shared(command, Shared::kOutFolder, &options.out)
      .fallback("out/study-first-robot; of --make-office a file, office_SEED.map");
  add_maps_option(command, options.maps);
  add_output_options(command, options);
  command.footer(
      "Writes findings.csv, rates.csv, runs.csv, charts as SVG and PNG, figure_26.png to figure_28.png, all "
      "tables "
      "as study.json, and a run folder of each run in cells/.\n"
      "With --make-office it writes NAME.map and, beside it, NAME.toml, NAME_faults.toml and "
      "NAME_robot.map.\n"
      "Exit status: 0 done; 5 a run failed, the others count; that of the first run where all failed.\n"
      "Example: hallway study first-robot --quick --out out/first-robot\n"
      "         hallway study first-robot --make-office 7 --out office.map");
}

}  // namespace hallway::cli
