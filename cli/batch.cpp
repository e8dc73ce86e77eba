// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/file.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "batch/table.hpp"
#include "batch_table.hpp"
#include "command.hpp"
#include "console.hpp"
#include "renderer_option.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct BatchOptions {
  std::string plan;
  std::string out;
  unsigned jobs = 1;
  std::optional<std::string> renderer;
  bool resume = false;
  bool json = false;
  bool quiet = false;
};

int run_batch(const BatchOptions& options) {
  const render::Renderer renderer = chosen_renderer(options.renderer);
  const batch::Plan plan = batch::read_plan(options.plan);
  const fs::path folder =
      options.out.empty() ? fs::path("out") / fs::path(options.plan).stem() : fs::path(options.out);
  catch_interrupts();
  Progress progress("runs", plan.cells.size(), options.quiet || options.json);
  const std::vector<batch::Result> results =
      batch::run_cells(plan, {.program = fs::read_symlink("/proc/self/exe"),
                              .folder = folder,
                              .jobs = options.jobs,
                              .resume = options.resume,
                              .environment = renderer_environment(renderer),
                              .progress = [&](std::size_t done) { progress.update(done); },
                              .stop = interrupted});
  const std::vector<std::string> violations = batch::violations(results, plan.thresholds);
  Json document = batch::to_json(results);
  document["runs"] = plan.cells.size();
  document["violations"] = violations;
  write_file_atomically(folder / batch::kTableFile, batch::print_csv(results));
  write_file_atomically(folder / batch::kDocumentFile, document.dump(1) + "\n");
  const auto reused =
      std::count_if(results.begin(), results.end(), [](const auto& result) { return result.reused; });
  if (options.json) {
    document["reused"] = reused;  // of this batch, not of what it gave: not in the file
    print_json(document);
  } else if (!options.quiet) {
    print_result(results_table(results) + failures_text(results, violations) +
                 fmt::format("{} of {} runs, {} of them taken over, in {}\n", results.size(),
                             plan.cells.size(), reused, printable(folder.string(), 4096)));
  }
  if (results.size() < plan.cells.size()) return interrupt_status();
  const bool good = violations.empty() && std::all_of(results.begin(), results.end(),
                                                      [](const auto& result) { return result.good(); });
  return good ? 0 : 1;
}

}  // namespace

void add_batch_command(CLI::App& app, Action& chosen) {
  CLI::App* command = app.add_subcommand(
      "batch",
      "Run every combination of scenarios, seeds, plugins and parameters, and tabulate what came out");
  const auto options = std::make_shared<BatchOptions>();
  command->add_option("plan", options->plan, "What to run (docs/formats.md, Batches)")
      ->required()
      ->type_name("FILE.toml");
  command->add_option("--out", options->out, "Folder to write [out/<plan>]")->type_name("DIR");
  command->add_option("--jobs", options->jobs, "How many runs at a time")
      ->type_name("N")
      ->check(CLI::Range(1u, 1024u))
      ->capture_default_str();
  add_renderer_option(*command, options->renderer);
  command->add_flag(
      "--resume", options->resume,
      "Keep results of an earlier batch in the folder where program, arguments and input files are the same");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->add_flag("--quiet", options->quiet, "Print no progress and no table");
  command->footer(
      "Writes results.csv, results.json, and a run folder and a log of each run in cells/.\n"
      "Exit status: 0 all runs are good and keep the plan's thresholds; 1 one is not or does not; 130 "
      "interrupted, and --resume goes on.\n"
      "Example: hallway batch sweep.toml --jobs 4 --resume");
  command->callback([&chosen, options] { chosen = [options] { return run_batch(*options); }; });
}

}  // namespace hallway::cli
