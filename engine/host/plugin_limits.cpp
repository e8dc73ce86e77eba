// SPDX-License-Identifier: MIT
#include "host/plugin_limits.hpp"

namespace hallway::host {
namespace {

constexpr Range kCallTimeout_s{0.01, 1e6};
constexpr std::int64_t kMinMemory_mib = 16;
constexpr std::int64_t kMaxMemory_mib = std::int64_t{1} << 24;

}  // namespace

PluginLimits read_plugin_limits(TableReader& table, const PluginLimits& defaults) {
  PluginLimits limits;
  limits.call_timeout_s = table.number("call_timeout_s", kCallTimeout_s, defaults.call_timeout_s);
  limits.memory_mib = static_cast<std::uint64_t>(table.whole(
      "memory_limit_mib", kMinMemory_mib, kMaxMemory_mib, static_cast<std::int64_t>(defaults.memory_mib)));
  limits.on_failure = static_cast<OnFailure>(
      table.choice("on_failure", kOnFailure, static_cast<std::size_t>(defaults.on_failure)));
  return limits;
}

}  // namespace hallway::host
