// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace hallway::test {

/// The root of the source tree: the environment variable HALLWAY_SOURCE_DIR (ctest sets it), else the working folder.
inline std::filesystem::path source_folder() {
  const char* folder = std::getenv("HALLWAY_SOURCE_DIR");
  return folder != nullptr && *folder != '\0' ? std::filesystem::path(folder)
                                              : std::filesystem::current_path();
}

/// The folder of large inputs that are not part of the repository: the environment variable HALLWAY_DATA, else
/// ../shared/data beside the source tree. It need not exist.
inline std::filesystem::path data_folder() {
  const char* folder = std::getenv("HALLWAY_DATA");
  if (folder != nullptr && *folder != '\0') return folder;
  return source_folder() / ".." / "shared" / "data";
}

}  // namespace hallway::test

/// Sets the path `variable` to `name` below data_folder(); skips the test, saying what is missing, where it is not there.
#define HALLWAY_DATA_OR_SKIP(variable, name)                                                             \
  const std::filesystem::path variable = hallway::test::data_folder() / (name);                          \
  if (!std::filesystem::exists(variable)) {                                                              \
    GTEST_SKIP() << "no test data at " << variable.string() << " (the environment variable HALLWAY_DATA" \
                 << " names the folder)";                                                                \
  }
