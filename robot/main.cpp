// SPDX-License-Identifier: MIT
#include <cstdio>

#include "record/version.hpp"

int main() {
  std::printf("hallway-robot %s\n", hallway::record::version().c_str());
  return 0;
}
