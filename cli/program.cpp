// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>

#include "base/error.hpp"
#include "base/text.hpp"
#include "console.hpp"

namespace hallway::cli {
namespace {

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
      throw Error(ErrorCode::kUsage,
                  fmt::format("there is no command \"{}{}\"{}; there are: {}", path, printable(wanted),
                              suggestion(wanted, names), fmt::join(names, ", ")));
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
  const int status = report_failure(Error(ErrorCode::kUsage, stop.what()), json);
  std::string name = command->get_name();
  for (const CLI::App* group = command->get_parent(); group != nullptr; group = group->get_parent()) {
    name = group->get_name() + " " + name;
  }
  fmt::print(stderr, "Try `{} --help`.\n", name);
  return status;
}

}  // namespace

bool asks_for_json(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0) return true;
  }
  return false;
}

int run_chosen(CLI::App& app, int argc, char** argv, const Action& chosen) {
  check_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& stop) {
    return report_parse(app, stop, asks_for_json(argc, argv));
  }
  return chosen();
}

}  // namespace hallway::cli
