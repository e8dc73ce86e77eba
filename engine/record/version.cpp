// SPDX-License-Identifier: MIT
#include "record/version.hpp"

namespace hallway::record {

std::string version() {
  return HALLWAY_VERSION;
}

}  // namespace hallway::record
