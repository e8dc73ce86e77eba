// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "command_line.hpp"
#include "planes/cloud.hpp"

namespace hallway::cli {

/// How a file of points is read, as the command line says it.
struct CloudInput {
  std::string columns;
  std::string intrinsics;
  double depth_scale = import::kDepthUnitsPerMetre;
};

/// Adds `--columns`, `--intrinsics` and `--depth-scale`.
void add_cloud_options(Command& command, CloudInput& input);

/// The same for planes::read_cloud(). Throws Error{kUsage}.
planes::CloudOptions cloud_options(const CloudInput& input);

}  // namespace hallway::cli
