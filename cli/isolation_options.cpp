// SPDX-License-Identifier: MIT
#include "isolation_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/text.hpp"

namespace hallway::cli {

void add_limit_options(Command& command, IsolationOptions& options) {
  command.flag(
      "--in-process", &options.in_process,
      "Run plugins in this process, for debuggers and benchmarks: no limits, and a crash is a crash of all");
  command
      .option("--call-timeout", &options.call_timeout_s,
              "Seconds that one call of a plugin may take [the scenario's, else 60]")
      .value("S")
      .range(0.01, 1e6);
  command
      .option("--memory-limit", &options.memory_limit_mib,
              "MiB of memory that a plugin's process may hold [the scenario's, else 4096]")
      .value("MIB")
      .range(16u, 1u << 24);
}

void add_isolation_options(Command& command, IsolationOptions& options) {
  add_limit_options(command, options);
  command
      .option("--on-failure", &options.on_failure,
              "When a plugin fails: stop (write what there is), continue (without answers) or restart (a "
              "new instance with "
              "an empty map); the exit status is 5 in any case [the scenario's, else stop]")
      .value("WHAT")
      .choices(host::kOnFailure);
}

host::PluginLimits apply(const IsolationOptions& options, host::PluginLimits limits) {
  if (options.call_timeout_s) limits.call_timeout_s = *options.call_timeout_s;
  if (options.memory_limit_mib) limits.memory_mib = *options.memory_limit_mib;
  if (options.on_failure) {
    const auto at = std::find(host::kOnFailure.begin(), host::kOnFailure.end(), *options.on_failure);
    limits.on_failure = static_cast<host::OnFailure>(at - host::kOnFailure.begin());
  }
  return limits;
}

std::vector<Override> overrides_of(const IsolationOptions& options) {
  std::vector<Override> overrides;
  if (options.call_timeout_s) overrides.push_back({"call_timeout_s", format_double(*options.call_timeout_s)});
  if (options.memory_limit_mib) {
    overrides.push_back({"memory_limit_mib", fmt::to_string(*options.memory_limit_mib)});
  }
  if (options.on_failure) overrides.push_back({"on_failure", *options.on_failure});
  return overrides;
}

std::optional<host::Isolation> isolation_of(const IsolationOptions& options,
                                            const host::PluginLimits& limits) {
  if (options.in_process) return std::nullopt;
  std::error_code problem;
  return host::Isolation{
      .call_time = std::chrono::milliseconds(static_cast<std::int64_t>(limits.call_timeout_s * 1e3 + 0.5)),
      .memory_bytes = limits.memory_mib << 20,
      .temporary = std::filesystem::temp_directory_path(problem)};
}

host::Isolation listing_isolation() {
  host::Isolation isolation = *isolation_of({}, {});
  isolation.call_time = std::chrono::seconds(10);
  return isolation;
}

}  // namespace hallway::cli
