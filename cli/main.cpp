// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "base/error.hpp"
#include "base/helper.hpp"
#include "base/text.hpp"
#include "batch/runner.hpp"
#include "command.hpp"
#include "console.hpp"
#include "run/manifest.hpp"

namespace {

constexpr const char* kAbout =
    "Headless map editor, simulator and plugin host for robot mapping algorithms: author a map in a shell, "
    "drive a\n"
    "simulated robot through it, load an algorithm as a shared object, measure what it mapped against the "
    "truth, and\n"
    "look at pictures of it.";

constexpr const char* kFooter =
    "Exit status: 0 done; 1 ran, and the answer is no; 2 usage; 3 bad input or I/O; 4 plugin not loadable;\n"
    "5 plugin misbehaved; 6 a bug in Hallway; 130 interrupted.";

/// A run that a batch has started ends with it. @return false if that is gone already
bool end_with_starter() {
  const char* starter = std::getenv(hallway::batch::kStartedBy);
  const auto number = starter != nullptr ? hallway::parse_uint(starter) : std::nullopt;
  return !number || hallway::end_with_parent(static_cast<std::int64_t>(*number));
}

bool asks_for_json(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0) return true;
  }
  return false;
}

/// The first words are the command; the parser would only say that one is required.
void check_command(const CLI::App& app, int argc, char** argv) {
  const CLI::App* group = &app;
  std::string path;
  for (int i = 1; i < argc && argv[i][0] != '-'; ++i) {
    std::vector<std::string> names;
    for (const CLI::App* command : group->get_subcommands({})) names.push_back(command->get_name());
    if (names.empty()) return;
    const std::string wanted = argv[i];
    if (std::find(names.begin(), names.end(), wanted) == names.end()) {
      throw hallway::Error(
          hallway::ErrorCode::kUsage,
          fmt::format("there is no command \"{}{}\"{}; there are: {}", path, hallway::printable(wanted),
                      hallway::suggestion(wanted, names), fmt::join(names, ", ")));
    }
    group = group->get_subcommand(wanted);
    path += wanted + " ";
  }
}

/// Help and version end a parse too, and are no failure.
int report_parse(const CLI::App& app, const CLI::ParseError& stop, bool json) {
  if (stop.get_exit_code() == 0) return app.exit(stop);
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  const int status =
      hallway::cli::report_failure(hallway::Error(hallway::ErrorCode::kUsage, stop.what()), json);
  std::string name = command->get_name();
  for (const CLI::App* group = command->get_parent(); group != nullptr; group = group->get_parent()) {
    name = group->get_name() + " " + name;
  }
  fmt::print(stderr, "Try `{} --help`.\n", name);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  hallway::cli::prepare_standard_streams();
  if (!end_with_starter()) return 1;
  const bool json = asks_for_json(argc, argv);
  try {
    CLI::App app(kAbout, "hallway");
    app.footer(kFooter);
    app.set_version_flag("--version", "hallway " + hallway::run::version());
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
    check_command(app, argc, argv);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& stop) {
      return report_parse(app, stop, json);
    }
    return chosen();
  } catch (const std::exception& failure) {
    return hallway::cli::report_failure(failure, json);
  }
}
