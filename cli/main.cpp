// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "base/helper.hpp"
#include "base/text.hpp"
#include "batch/runner.hpp"
#include "command.hpp"
#include "console.hpp"
#include "record/version.hpp"

namespace {

constexpr const char* kAbout =
    "Headless map editor, simulator and plugin host for robot mapping algorithms: author a map in a shell, "
    "drive a\n"
    "simulated robot through it, load an algorithm as a shared object, measure what it mapped against the "
    "truth, and\n"
    "look at pictures of it.";

/// A run that a batch has started ends with it. @return false if that is gone already
bool end_with_starter() {
  const char* starter = std::getenv(hallway::batch::kStartedBy);
  const auto number = starter != nullptr ? hallway::parse_uint(starter) : std::nullopt;
  return !number || hallway::end_with_parent(static_cast<std::int64_t>(*number));
}

}  // namespace

int main(int argc, char** argv) {
  hallway::cli::prepare_standard_streams();
  if (!end_with_starter()) return 1;
  const bool json = hallway::cli::asks_for_json(argc, argv);
  try {
    CLI::App app(kAbout, "hallway");
    app.footer(hallway::cli::kExitStatusHelp);
    app.set_version_flag("--version", "hallway " + hallway::record::version());
    app.require_subcommand(1);
    hallway::cli::Action chosen;
    hallway::cli::add_run_command(app, chosen);
    hallway::cli::add_replay_command(app, chosen);
    hallway::cli::add_serve_command(app, chosen);
    hallway::cli::add_score_command(app, chosen);
    hallway::cli::add_compare_command(app, chosen);
    hallway::cli::add_batch_command(app, chosen);
    hallway::cli::add_study_command(app, chosen);
    hallway::cli::add_log_command(app, chosen);
    hallway::cli::add_render_command(app, chosen);
    hallway::cli::add_plugin_command(app, chosen);
    hallway::cli::add_planes_command(app, chosen);
    hallway::cli::add_bench_em_command(app, chosen);
    hallway::cli::add_import_command(app, chosen);
    hallway::cli::add_align_command(app, chosen);
    hallway::cli::add_compile_command(app, chosen);
    hallway::cli::add_map_command(app, chosen);
    hallway::cli::add_edit_command(app, chosen);
    hallway::cli::add_doctor_command(app, chosen);
    return hallway::cli::run_chosen(app, argc, argv, chosen);
  } catch (const std::exception& failure) {
    return hallway::cli::report_failure(failure, json);
  }
}
