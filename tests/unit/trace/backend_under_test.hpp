// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <string_view>

#include "trace/scene.hpp"

namespace hallway::trace {

/// The backend on which the rules of a scene are tried: HALLWAY_TEST_BACKEND, `embree` or `brute_force`; Embree where it is not set.
inline Backend backend_under_test() {
  const char* name = std::getenv("HALLWAY_TEST_BACKEND");
  if (name == nullptr || std::string_view(name) == "embree") return Backend::kEmbree;
  if (std::string_view(name) == "brute_force") return Backend::kBruteForce;
  std::abort();  // a name that is no backend's must not pass as one
}

/// Of this run of the program.
inline const Backend kBackend = backend_under_test();

}  // namespace hallway::trace
