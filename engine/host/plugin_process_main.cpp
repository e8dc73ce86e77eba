// SPDX-License-Identifier: MIT
// The program in which an isolated plugin runs; the host starts it, nobody else.
#include <unistd.h>

#include <cstdlib>

#include "host/plugin_server.hpp"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HALLWAY_ADDRESS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define HALLWAY_ADDRESS_SANITIZER
#endif

#ifdef HALLWAY_ADDRESS_SANITIZER
/// Looking for leaks takes what a confined process may not do: one that ends itself would end with another status than its own.
extern "C" const char* __asan_default_options() {
  return "detect_leaks=0";
}
#endif

int main(int argc, char** argv) {
  if (argc != 2) {
    static constexpr char kText[] = "This program is started by hallway; it holds one plugin.\n";
    return ::write(2, kText, sizeof kText - 1) > 0 ? 2 : 1;
  }
  hallway::host::serve_plugin(std::atol(argv[1]));
}
