// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/plugin.h>

#include <cstdint>
#include <string>
#include <vector>

namespace hallway::host {

/// What a plugin says of itself, checked and copied. Texts are safe to print.
struct PluginInfo {
  std::string id;                      ///< unique; letters, digits, _ - .
  std::string name;                    ///< for people
  std::string version;                 ///< the plugin's own
  std::string vendor;                  ///< who made it
  std::string description;             ///< one sentence
  std::vector<std::uint32_t> inputs;   ///< HW_SAMPLE_… kinds that it needs
  std::vector<std::uint32_t> outputs;  ///< HW_OUTPUT_… kinds that it may put
};

/// Checks and copies what a plugin says of itself. Throws Error{kPluginLoad} naming the member that is not as
/// plugin.h says.
PluginInfo read_plugin_info(const hw_plugin_info_t* info);

/// A stable name for a sample kind: "points", "planes", …; "kind 77" for an unknown one.
std::string sample_kind_name(std::uint32_t kind);

/// A stable name for an output kind: "pose", "landmarks", …; "kind 77" for an unknown one.
std::string output_kind_name(std::uint32_t kind);

}  // namespace hallway::host
