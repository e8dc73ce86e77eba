// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/table_reader.hpp"

namespace hallway::host {

/// What becomes of a run when a plugin fails.
enum class OnFailure {
  kStop,      ///< it ends, and what there is so far is written
  kContinue,  ///< the frames after it have no answer
  kRestart,   ///< a new instance, with an empty map, goes on with the frame after it
};

/// "stop", "continue", "restart", in the order of OnFailure.
inline const std::vector<std::string> kOnFailure{"stop", "continue", "restart"};

inline const char* on_failure_name(OnFailure policy) {
  return kOnFailure[static_cast<std::size_t>(policy)].c_str();
}

/// What plugins are held to.
struct PluginLimits {
  double call_timeout_s = 60.0;     ///< wall clock; 0.01 at least
  std::uint64_t memory_mib = 4096;  ///< of a plugin's process
  OnFailure on_failure = OnFailure::kStop;
};

/// The keys that read_plugin_limits() reads.
inline const std::vector<std::string> kPluginLimitKeys{"call_timeout_s", "memory_limit_mib", "on_failure"};

/// Reads `call_timeout_s`, `memory_limit_mib` and `on_failure`; what is missing is as in `defaults`. Throws as TableReader does.
PluginLimits read_plugin_limits(TableReader& table, const PluginLimits& defaults);

}  // namespace hallway::host
