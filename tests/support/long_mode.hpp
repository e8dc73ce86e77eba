// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <cstring>

namespace hallway::test {

/// True where the environment variable HALLWAY_TEST_LONG is 1: tests then run at their full size.
inline bool long_mode() {
  const char* value = std::getenv("HALLWAY_TEST_LONG");
  return value != nullptr && std::strcmp(value, "1") == 0;
}

/// `usual` on every day, `full` in long mode.
template <typename T>
T sized(T usual, T full) {
  return long_mode() ? full : usual;
}

}  // namespace hallway::test
