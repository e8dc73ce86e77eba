// SPDX-License-Identifier: MIT
// The program in which an isolated plugin runs; the host starts it, nobody else.
#include <unistd.h>

#include <cstdlib>

#include "host/isolate/plugin_server.hpp"
#include "host/load/no_leak_check.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    static constexpr char kText[] = "This program is started by hallway; it holds one plugin.\n";
    return ::write(2, kText, sizeof kText - 1) > 0 ? 2 : 1;
  }
  hallway::host::serve_plugin(std::atol(argv[1]));
}
