// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "batch/table.hpp"
#include "batch_table.hpp"
#include "command.hpp"
#include "console.hpp"
#include "plugin_sweep.hpp"
#include "renderer_option.hpp"
#include "run/pictures.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct CompareOptions {
  std::string input;
  std::vector<std::string> plugins;
  std::vector<std::string> settings;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint32_t> steps;
  std::string out;
  std::string view = "top";
  std::optional<std::string> renderer;
  unsigned jobs = 1;
  bool json = false;
  bool quiet = false;
};

batch::Plan plan_of(const CompareOptions& options) {
  batch::Dimensions dimensions;
  dimensions.inputs = {options.input};
  for (const std::string& plugin : options.plugins) dimensions.plugins.push_back(parse_plugin_sweep(plugin));
  for (const std::string& setting : options.settings)
    dimensions.more.insert(dimensions.more.end(), {"--set", setting});
  if (options.seed) dimensions.more.insert(dimensions.more.end(), {"--seed", fmt::to_string(*options.seed)});
  if (options.steps)
    dimensions.more.insert(dimensions.more.end(), {"--steps", fmt::to_string(*options.steps)});
  return {.cells = batch::combine(dimensions)};
}

/// The picture of all runs that left something. @return its file, empty where there was nothing to draw
fs::path draw(const CompareOptions& options, render::Renderer renderer, const fs::path& folder,
              const std::vector<batch::Result>& results) {
  std::vector<std::unique_ptr<run::Record>> records;
  std::vector<run::Compared> runs;
  for (const batch::Result& result : results) {
    const fs::path cell = folder / "cells" / result.name;
    if (!run::is_run_folder(cell)) continue;
    records.push_back(std::make_unique<run::Record>(run::read_record(cell)));
    runs.push_back({result.name, *records.back()});
  }
  if (runs.empty()) return {};
  sim::PictureSpec spec;
  spec.view = options.view == "top" ? sim::PictureView::kTop : sim::PictureView::kPerspective;
  spec.show = {sim::PictureLayer::kMap, sim::PictureLayer::kTruth, sim::PictureLayer::kEstimate,
               sim::PictureLayer::kLandmarks};
  const fs::path file = folder / "comparison.png";
  write_file_atomically(file, run::draw_comparison(runs, spec, {.renderer = renderer}));
  return file;
}

int compare(const CompareOptions& options) {
  const render::Renderer renderer = chosen_renderer(options.renderer);
  render::demand(renderer);
  const batch::Plan plan = plan_of(options);
  const fs::path folder = options.out.empty()
                              ? fs::path("out") / (fs::path(options.input).stem().string() + "-compared")
                              : fs::path(options.out);
  catch_interrupts();
  Progress progress("runs", plan.cells.size(), options.quiet || options.json);
  const std::vector<batch::Result> results =
      batch::run_cells(plan, {.program = fs::read_symlink("/proc/self/exe"),
                              .folder = folder,
                              .jobs = options.jobs,
                              .environment = renderer_environment(renderer),
                              .progress = [&](std::size_t done) { progress.update(done); },
                              .stop = interrupted});
  if (results.size() < plan.cells.size()) return interrupt_status();
  fs::path picture;
  try {
    picture = draw(options, renderer, folder, results);
  } catch (const Error& error) {  // what the runs came to is worth more than their picture
    print_warning(std::string("no picture: ") + error.what());
  }
  Json document = batch::to_json(results);
  document["picture"] = printable(picture.string(), 4096);
  write_file_atomically(folder / "results.csv", batch::print_csv(results));
  write_file_atomically(folder / "results.json", document.dump(1) + "\n");
  if (options.json) {
    print_json(document);
  } else if (!options.quiet) {
    print_result(results_table(results) + failures_text(results, {}) +
                 (picture.empty() ? "" : printable(picture.string(), 4096) + "\n"));
  }
  // The first failure's own status says most: a plugin that is not there, or that misbehaved.
  for (const batch::Result& result : results) {
    if (!result.good()) return result.status;
  }
  return 0;
}

}  // namespace

void add_compare_command(CLI::App& app, Action& chosen) {
  CLI::App* command = app.add_subcommand(
      "compare",
      "Give several plugins, or one with several parameters, the same input, and show what each made of it");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("input", options->input, "A scenario, a log (.csv, .mcap), or the folder of a run")
      ->required()
      ->type_name("SCENARIO|LOG");
  command
      ->add_option("--plugin", options->plugins,
                   "A plugin, an id or a file, and values of its parameters, which are tried each with each; "
                   "may be given several times")
      ->type_name("NAME[:param=a,b,...]...")
      ->required()
      ->take_all()
      ->expected(1);
  command->add_option("--set", options->settings, "Set a scenario value for all; may be given several times")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->expected(1);
  command->add_option("--seed", options->seed, "Seed, instead of the scenario's")->type_name("N");
  command->add_option("--steps", options->steps, "Number of iterations, instead of the scenario's")
      ->type_name("N");
  command->add_option("--out", options->out, "Folder to write [out/<input>-compared]")->type_name("DIR");
  command->add_option("--view", options->view, "Of the picture")
      ->check(CLI::IsMember({"top", "perspective"}))
      ->capture_default_str();
  add_renderer_option(*command, options->renderer);
  command->add_option("--jobs", options->jobs, "How many runs at a time; times are fair with 1")
      ->type_name("N")
      ->check(CLI::Range(1u, 1024u))
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print one JSON document");
  command->add_flag("--quiet", options->quiet, "Print no progress and no table");
  command->footer(
      "Writes a table (results.csv, results.json), comparison.png with all maps over the truth, and the "
      "folder of each run in cells/.\n"
      "Exit status: 0, or that of the first run that failed.\n"
      "Example: hallway compare maps/office.toml --plugin slam_point:noise_m=0.01,0.05 --plugin "
      "build/my_slam.so");
  command->callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
}

}  // namespace hallway::cli
