// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "batch/plan.hpp"

namespace hallway::cli {

/// "slam_point:noise_m=0.01,0.05:mode=thesis": a plugin, and values of its parameters that are tried each with each. "FILE.so:ID" names one
/// of several plugins of a file. Throws Error{kUsage} for anything else.
batch::PluginSweep parse_plugin_sweep(const std::string& text);

}  // namespace hallway::cli
