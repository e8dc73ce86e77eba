// SPDX-License-Identifier: MIT
#include "console.hpp"
#include "record/version.hpp"
#include "robot/command.hpp"

namespace {

constexpr const char* kAbout =
    "Carries mapping plugins to hardware: a driver gives frames of a robot, the plugins answer them, and the "
    "robot gets\n"
    "their commands.";

}  // namespace

int main(int argc, char** argv) {
  hallway::cli::prepare_standard_streams();
  const bool json = hallway::cli::asks_for_json(argc, argv);
  try {
    CLI::App app(kAbout, "hallway-robot");
    app.footer(hallway::cli::kExitStatusHelp);
    app.set_version_flag("--version", "hallway-robot " + hallway::record::version());
    app.require_subcommand(1);
    hallway::cli::Action chosen;
    hallway::robot::add_run_command(app, chosen);
    hallway::robot::add_check_command(app, chosen);
    hallway::robot::add_drivers_command(app, chosen);
    hallway::robot::add_profile_command(app, chosen);
    return hallway::cli::run_chosen(app, argc, argv, chosen);
  } catch (const std::exception& failure) {
    return hallway::cli::report_failure(failure, json);
  }
}
