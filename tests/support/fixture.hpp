// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "support/process.hpp"

namespace hallway::test {

/// The file of a plugin of tests/abi/fixtures.
inline std::string fixture(const std::string& name) {
  return (binary_folder() / "tests" / "abi" / "fixtures" / (name + ".so")).string();
}

}  // namespace hallway::test
