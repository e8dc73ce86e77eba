// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hallway::test {

/// A Python 3 that has numpy: the environment variable HALLWAY_PYTHON, the system's, or the one of the search path.
inline std::optional<std::string> python_with_numpy() {
  std::vector<std::string> candidates = {"/usr/bin/python3", "python3"};
  const char* chosen = std::getenv("HALLWAY_PYTHON");
  if (chosen != nullptr && *chosen != '\0') candidates = {chosen};
  for (const std::string& python : candidates) {
    const std::string command = "'" + python + "' -c 'import numpy' >/dev/null 2>&1";
    if (std::system(command.c_str()) == 0) return python;
  }
  return std::nullopt;
}

/// Runs `python script arguments…` and gives its exit status. No text may contain a single quote.
inline int run_python(const std::string& python,
                      const std::vector<std::filesystem::path>& script_and_arguments) {
  std::string command = "'" + python + "' -B";  // -B: leaves no __pycache__ in the source tree
  for (const auto& part : script_and_arguments) command += " '" + part.string() + "'";
  return std::system(command.c_str());
}

}  // namespace hallway::test
