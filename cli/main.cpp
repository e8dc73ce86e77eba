// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "base/helper.hpp"
#include "base/text.hpp"
#include "batch/runner.hpp"
#include "command.hpp"
#include "console.hpp"
#include "help_commands.hpp"
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
    hallway::cli::Command app("hallway", kAbout);
    app.summary("headless map editor, simulator and plugin host for robot mapping algorithms");
    app.footer(hallway::cli::kExitStatusHelp);
    app.version("hallway " + hallway::record::version());
    hallway::cli::add_run_command(app);
    hallway::cli::add_replay_command(app);
    hallway::cli::add_serve_command(app);
    hallway::cli::add_score_command(app);
    hallway::cli::add_compare_command(app);
    hallway::cli::add_batch_command(app);
    hallway::cli::add_study_command(app);
    hallway::cli::add_log_command(app);
    hallway::cli::add_render_command(app);
    hallway::cli::add_plugin_command(app);
    hallway::cli::add_driver_command(app);
    hallway::cli::add_planes_command(app);
    hallway::cli::add_bench_em_command(app);
    hallway::cli::add_scenario_command(app);
    hallway::cli::add_import_command(app);
    hallway::cli::add_align_command(app);
    hallway::cli::add_compile_command(app);
    hallway::cli::add_map_command(app);
    hallway::cli::add_edit_command(app);
    hallway::cli::add_doctor_command(app);
    hallway::cli::add_help_commands(app);
    return hallway::cli::run_program(app, argc, argv);
  } catch (const std::exception& failure) {
    return hallway::cli::report_failure(failure, json);
  }
}
