// SPDX-License-Identifier: MIT
#pragma once

#include "node/packages.hpp"

namespace hallway::test {

/// Runs the Khronos glTF validator on a file: status 0 for no error and no warning, else 1; its issues are on `out`.
inline Ended validate_gltf(const std::filesystem::path& validator, const std::filesystem::path& file) {
  return run_node(validator, "validate.js", file);
}

}  // namespace hallway::test

/// Sets `variable` to the folder of the validator; skips the test, saying why, where it cannot be had.
#define HALLWAY_GLTF_VALIDATOR_OR_SKIP(variable) HALLWAY_NODE_PACKAGE_OR_SKIP(variable, "gltf-validator")
