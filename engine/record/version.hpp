// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace hallway::record {

/// Hallway's version, e.g. "0.1.0".
std::string version();

}  // namespace hallway::record
