// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "batch/redraw.hpp"
#include "batch/table.hpp"
#include "batch_table.hpp"
#include "command.hpp"
#include "console.hpp"
#include "output_file.hpp"
#include "renderer_option.hpp"
#include "run/pictures/pictures.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

struct BatchOptions : OutputOptions {
  std::string plan;
  std::string out;
  unsigned jobs = 1;
  std::optional<std::string> renderer;
  bool resume = false;
};

/// Draws errors longer by one power of ten in all pictures of a batch: the smallest of those that the runs would have each by itself.
void share_error_scale(const batch::Plan& plan, const batch::RunnerSetup& setup,
                       const std::vector<batch::Result>& results) {
  if (plan.pictures.empty()) return;
  std::optional<double> common;
  bool alike = std::ranges::none_of(results, [](const auto& result) { return result.reused; });
  for (const batch::Result& result : results) {
    const fs::path cell = setup.folder / "cells" / result.name;
    if (!run::is_run_folder(cell)) continue;
    const auto scale = run::error_scale_of(run::read_record(cell));
    if (!scale) continue;
    alike = alike && scale == common.value_or(*scale);
    common = std::min(common.value_or(*scale), *scale);
  }
  if (alike || !common) return;
  for (const std::string& name :
       batch::redraw_pictures(plan, setup, {"--error-scale", format_double(*common)}))
    print_warning("not drawn again with the errors' common scale: " + name);
}

int run_batch(const BatchOptions& options) {
  const render::Renderer renderer = chosen_renderer(options.renderer);
  const batch::Plan plan = batch::read_plan(options.plan);
  const fs::path folder = output_folder(options.out, fs::path(options.plan).stem());
  check_output_folder(folder, batch::kDocumentFile, options.force || options.resume);
  catch_interrupts();
  Progress progress("runs", plan.cells.size(), options.quiet || options.json);
  const batch::RunnerSetup setup{.program = fs::read_symlink("/proc/self/exe"),
                                 .folder = folder,
                                 .jobs = options.jobs,
                                 .resume = options.resume,
                                 .replace = options.force && !options.resume,
                                 .environment = renderer_environment(renderer),
                                 .progress = [&](std::size_t done) { progress.update(done); },
                                 .stop = interrupted};
  const std::vector<batch::Result> results = batch::run_cells(plan, setup);
  try {
    if (results.size() == plan.cells.size()) share_error_scale(plan, setup, results);
  } catch (const Error& error) {  // what the runs came to is worth more than their pictures
    print_warning(std::string("the pictures have error scales of their own: ") + error.what());
  }
  const std::vector<std::string> violations = batch::violations(results, plan);
  Json document = batch::to_json(results);
  document["runs"] = plan.cells.size();
  document["violations"] = violations;
  write_file_atomically(folder / batch::kTableFile, batch::print_csv(results));
  write_file_atomically(folder / batch::kDocumentFile, document.dump(1) + "\n");
  const auto reused = std::ranges::count_if(results, [](const auto& result) { return result.reused; });
  if (options.json) {
    document["reused"] = reused;  // of this batch, not of what it gave: not in the file
    print_json(document);
  } else if (!options.quiet) {
    print_result(results_table(results) + failures_text(results, violations) +
                 fmt::format("{} of {} runs, {} of them reused, in {}\n", results.size(), plan.cells.size(),
                             reused, path_text(folder)));
  } else if (const std::string failures = failures_text(results, violations); !failures.empty()) {
    print_notice(failures);
  }
  if (results.size() < plan.cells.size()) return interrupt_status();
  const bool good =
      violations.empty() && std::ranges::all_of(results, [](const auto& result) { return result.good(); });
  return good ? 0 : 1;
}

}  // namespace

void add_batch_command(Command& app) {
  Command& command = app.command(
      "batch", "Run every combination of scenarios, seeds, plugins and parameters, and tabulate the results");
  BatchOptions& options = command.runs(&run_batch);
  command.argument("plan", &options.plan, "What to run (docs/formats.md, Batches)").required().value("PLAN");
  add_shared(command, Shared::kOutFolder, &options.out).fallback("out/<plan>");
  add_shared(command, Shared::kJobs, &options.jobs).show_default();
  add_renderer_option(command, options.renderer);
  command.flag(
      "--resume", &options.resume,
      "Keep results of an earlier batch in the folder where program, arguments and input files are the same");
  add_output_options(command, options);
  command.footer(
      "Writes results.csv, results.json, and a run folder and a log of each run in cells/.\n"
      "Exit status: 0 all runs are good and keep the plan's thresholds; 1 one is not or does not; 130 "
      "interrupted, and --resume goes on.\n"
      "Example: hallway batch sweep.toml --jobs 4 --resume");
}

}  // namespace hallway::cli
