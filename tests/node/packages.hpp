// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "support/data.hpp"
#include "support/process.hpp"

namespace hallway::test {

/// The folder with the npm packages of tests/node: `node` in the build tree, installed there when one that is missing is first
/// asked for. Empty where npm, node or the network is missing; `why` then says so.
inline std::filesystem::path node_folder(const std::string& package, std::string& why) {
  namespace fs = std::filesystem;
  const fs::path folder = binary_folder() / "node";
  if (fs::exists(folder / "node_modules" / package / "package.json")) return folder;
  fs::create_directories(folder);
  for (const char* name : {"package.json", "package-lock.json"}) {
    fs::copy_file(source_folder() / "tests" / "node" / name, folder / name,
                  fs::copy_options::overwrite_existing);
  }
  const Ended ended = Process({"/usr/bin/env", "npm", "ci", "--no-audit", "--no-fund", "--ignore-scripts",
                               "--fetch-retries=1", "--fetch-timeout=20000"},
                              folder)
                          .wait();
  if (ended.status == 0) return folder;
  why = package + " is not there: `npm ci` ended with status " + std::to_string(ended.status);
  return {};
}

/// Runs a script of tests/node on a file, in the folder of the packages.
inline Ended run_node(const std::filesystem::path& packages, const std::string& script,
                      const std::filesystem::path& file) {
  return Process({"/usr/bin/env", "node",
                  (std::filesystem::absolute(source_folder()) / "tests/node" / script).string(),
                  std::filesystem::absolute(file).string()},
                 packages)
      .wait();
}

}  // namespace hallway::test

/// Sets `variable` to the folder that has an npm package; skips the test, saying why, where it cannot be had.
#define HALLWAY_NODE_PACKAGE_OR_SKIP(variable, package)                                       \
  std::string variable##_why;                                                                 \
  const std::filesystem::path variable = hallway::test::node_folder(package, variable##_why); \
  if (variable.empty()) {                                                                     \
    GTEST_SKIP() << variable##_why;                                                           \
  }
