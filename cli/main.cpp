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
  using namespace hallway::cli;
  prepare_standard_streams();
  if (!end_with_starter()) return 1;
  const bool json = asks_for_json(argc, argv);
  try {
    Command app("hallway", kAbout);
    app.summary("headless map editor, simulator and plugin host for robot mapping algorithms");
    app.footer(kExitStatusHelp);
    app.version("hallway " + hallway::record::version());
    add_run_command(app);
    add_watch_command(app);
    add_replay_command(app);
    add_serve_command(app);
    add_score_command(app);
    add_compare_command(app);
    add_batch_command(app);
    add_study_command(app);
    add_log_command(app);
    add_render_command(app);
    add_plugin_command(app);
    add_driver_command(app);
    add_planes_command(app);
    add_bench_em_command(app);
    add_scenario_command(app);
    add_robot_command(app);
    add_sensors_command(app);
    add_import_command(app);
    add_align_command(app);
    add_compile_command(app);
    add_map_command(app);
    add_edit_command(app);
    add_doctor_command(app);
    add_help_commands(app);
    return run_program(app, argc, argv);
  } catch (const std::exception& failure) {
    return report_failure(failure, json);
  }
}
