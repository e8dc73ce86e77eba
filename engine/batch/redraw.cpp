// SPDX-License-Identifier: MIT
#include "batch/redraw.hpp"

#include <unistd.h>

#include <chrono>

#include "base/spawn.hpp"

namespace hallway::batch {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// @return whether the program ended well
bool run(const RunnerSetup& setup, const std::vector<std::string>& arguments) {
  ProcessSetup process;
  process.arguments = arguments;
  process.descriptors = {-1, -1, -1};
  process.environment = setup.environment;
  process.environment.push_back(std::string(kStartedBy) + "=" + std::to_string(::getpid()));
  ProcessGroup group(setup.program, process);
  constexpr auto kLook = std::chrono::milliseconds(20);
  while (!group.ended_by(Clock::now() + kLook)) {
    if (setup.stop && setup.stop()) return false;
  }
  const ProcessEnd end = group.kill();
  return !end.signalled && end.number == 0;
}

}  // namespace

std::vector<std::string> redraw_pictures(const Plan& plan, const RunnerSetup& setup,
                                         const std::vector<std::string>& more) {
  std::vector<std::string> failed;
  std::error_code none;
  for (const Cell& cell : plan.cells) {
    const fs::path folder = setup.folder / "cells" / cell.name;
    if (!fs::exists(folder / "run.json", none)) continue;
    for (const PictureRequest& picture : plan.pictures) {
      if (setup.stop && setup.stop()) return failed;
      std::vector<std::string> arguments{"render", folder.string()};
      arguments.insert(arguments.end(), picture.arguments.begin(), picture.arguments.end());
      arguments.insert(arguments.end(), more.begin(), more.end());
      const std::string name = picture_name(cell, picture);
      arguments.insert(arguments.end(), {"--out", (folder.parent_path() / name).string()});
      if (!run(setup, arguments)) failed.push_back(name);
    }
  }
  return failed;
}

}  // namespace hallway::batch
