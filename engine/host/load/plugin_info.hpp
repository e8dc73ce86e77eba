// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace hallway::host {

/// What a plugin says of itself, checked and copied. Texts are safe to print.
struct PluginInfo {
  std::string id;                                ///< unique; letters, digits, _ - .
  std::string name;                              ///< for people
  std::string version;                           ///< the plugin's own
  std::string vendor;                            ///< who made it
  std::string description;                       ///< one sentence
  std::vector<std::uint32_t> inputs;             ///< HW_SAMPLE_… kinds that it needs
  std::vector<std::uint32_t> optional_inputs{};  ///< those that it takes where there are any
  std::vector<std::uint32_t> outputs;            ///< HW_OUTPUT_… kinds that it may put

  /// Whether it is given samples of a kind.
  bool takes(std::uint32_t kind) const {
    return std::ranges::find(inputs, kind) != inputs.end() ||
           std::ranges::find(optional_inputs, kind) != optional_inputs.end();
  }
};

/// Checks and copies what a plugin says of itself. Throws Error{kPluginLoad} naming the member that is not as
/// plugin.h says.
PluginInfo read_plugin_info(const hw_plugin_info_t* info);

}  // namespace hallway::host
