// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace hallway::test {

/// The environment variable by which processes are known that descend from this one, however far.
inline constexpr const char* kProcessMark = "HALLWAY_TEST_MARK";

/// Marks every process that is started from now on with this environment.
inline void mark_processes() {
  ::setenv(kProcessMark, std::to_string(::getpid()).c_str(), 1);
}

/// Processes with this process's mark, but this one.
inline std::vector<std::string> marked_processes() {
  namespace fs = std::filesystem;
  const std::string own = std::to_string(::getpid());
  const std::string mark = std::string(kProcessMark) + "=" + own;
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos || name == own) continue;
    std::ifstream file(entry.path() / "environ", std::ios::binary);
    const std::string environment{std::istreambuf_iterator<char>(file), {}};
    const std::size_t at = environment.find(mark);
    if (at != std::string::npos && environment[at + mark.size()] == '\0') found.push_back(name);
  }
  return found;
}

/// The same, once those that have been told to end have had time to.
inline std::vector<std::string> lasting_processes() {
  std::vector<std::string> found = marked_processes();
  for (int i = 0; i < 1000 && !found.empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    found = marked_processes();
  }
  return found;
}

}  // namespace hallway::test
