// SPDX-License-Identifier: MIT
// The program in which one test of a plugin runs; `hallway plugin validate` starts it, nobody else.
#include <unistd.h>

#include <exception>

#include "conformance/test_process.hpp"
#include "host/load/no_leak_check.hpp"

int main(int argc, char** argv) {
  if (argc < 2) {
    static constexpr char kText[] = "This program is started by hallway; it runs one test of a plugin.\n";
    return ::write(2, kText, sizeof kText - 1) > 0 ? 2 : 1;
  }
  try {
    hallway::conformance::run_test_process({argv + 1, argv + argc});
  } catch (const std::exception&) {  // nobody can be told: whoever started it sees it end
    return 1;
  }
}
