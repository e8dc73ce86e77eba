// SPDX-License-Identifier: MIT
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

}  // namespace

int main(int argc, char** argv) {
  hallway::cli::prepare_standard_streams();
  const bool json = hallway::cli::asks_for_json(argc, argv);
  try {
    CLI::App app(kAbout, "hallway");
    app.footer(hallway::cli::kExitStatusHelp);
    app.set_version_flag("--version", "hallway " + hallway::record::version());
    app.require_subcommand(1);
    hallway::cli::Action chosen;
    hallway::cli::add_run_command(app, chosen);
    hallway::cli::add_replay_command(app, chosen);
    hallway::cli::add_compare_command(app, chosen);
    hallway::cli::add_batch_command(app, chosen);
    hallway::cli::add_log_command(app, chosen);
    hallway::cli::add_render_command(app, chosen);
    hallway::cli::add_plugin_command(app, chosen);
    hallway::cli::add_import_command(app, chosen);
    hallway::cli::add_compile_command(app, chosen);
    hallway::cli::add_map_command(app, chosen);
    hallway::cli::add_edit_command(app, chosen);
    hallway::cli::add_doctor_command(app, chosen);
    return hallway::cli::run_chosen(app, argc, argv, chosen);
  } catch (const std::exception& failure) {
    return hallway::cli::report_failure(failure, json);
  }
}
