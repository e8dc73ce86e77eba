// SPDX-License-Identifier: MIT
#include "plugin_sweep.hpp"

#include "plugin_argument.hpp"

namespace hallway::cli {

batch::PluginSweep parse_plugin_sweep(const std::string& text) {
  const PluginArgument argument = parse_plugin_argument(text);
  batch::PluginSweep sweep{.plugin = argument.plugin, .parameters = {}};
  for (const PluginArgument::Values& parameter : argument.parameters)
    sweep.parameters.push_back({parameter.name, parameter.values});
  return sweep;
}

}  // namespace hallway::cli
