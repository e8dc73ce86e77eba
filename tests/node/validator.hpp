// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "support/data.hpp"
#include "support/process.hpp"

namespace hallway::test {

/// The folder with the Khronos glTF validator: `node` in the build tree, installed there by npm when it is first asked for.
/// Empty where npm, node or the network is missing; `why` then says so.
inline std::filesystem::path gltf_validator_folder(std::string& why) {
  namespace fs = std::filesystem;
  const fs::path folder = binary_folder() / "node";
  if (fs::exists(folder / "node_modules" / "gltf-validator" / "package.json")) return folder;
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
  why = "the glTF validator is not there: `npm ci` ended with status " + std::to_string(ended.status);
  return {};
}

/// Runs the validator on a file: status 0 for no error and no warning, else 1; its issues are on `out`.
inline Ended validate_gltf(const std::filesystem::path& validator, const std::filesystem::path& file) {
  return Process({"/usr/bin/env", "node",
                  (std::filesystem::absolute(source_folder()) / "tests/node/validate.js").string(),
                  std::filesystem::absolute(file).string()},
                 validator)
      .wait();
}

}  // namespace hallway::test

/// Sets `variable` to the folder of the validator; skips the test, saying why, where it cannot be had.
#define HALLWAY_GLTF_VALIDATOR_OR_SKIP(variable)                                               \
  std::string variable##_why;                                                                  \
  const std::filesystem::path variable = hallway::test::gltf_validator_folder(variable##_why); \
  if (variable.empty()) {                                                                      \
    GTEST_SKIP() << variable##_why;                                                            \
  }
