// SPDX-License-Identifier: MIT
#include "console.hpp"
#include "help_commands.hpp"
#include "record/version.hpp"
#include "robot/command.hpp"

namespace {

constexpr const char* kAbout =
    "Carries mapping plugins to hardware: a driver gives frames of a robot, the plugins answer them, and the "
    "robot gets\n"
    "their commands.";

}  // namespace

int main(int argc, char** argv) {
  using namespace hallway::cli;
  prepare_standard_streams();
  const bool json = asks_for_json(argc, argv);
  try {
    Command app("hallway-robot", kAbout);
    app.summary("run mapping plugins on a robot");
    app.footer(kExitStatusHelp);
    app.version("hallway-robot " + hallway::record::version());
    hallway::robot::add_run_command(app);
    hallway::robot::add_check_command(app);
    hallway::robot::add_drivers_command(app);
    hallway::robot::add_profile_command(app);
    add_help_commands(app);
    return run_program(app, argc, argv);
  } catch (const std::exception& failure) {
    return report_failure(failure, json);
  }
}
