// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "batch/plan.hpp"

namespace hallway::cli {

/// What `--plugin` says (plugin_argument.hpp) where a command tries all values of each parameter with all of the others:
/// "slam_point:noise_m=0.01,0.05,mode=thesis". Throws Error{kUsage}.
batch::PluginSweep parse_plugin_sweep(const std::string& text);

}  // namespace hallway::cli
