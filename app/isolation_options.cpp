// SPDX-License-Identifier: MIT
#include "isolation_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/text.hpp"
#include "shared_options.hpp"

namespace hallway::cli {

namespace {

void add_limits(Command& command, IsolationOptions& options, const std::string& source) {
  const host::PluginLimits defaults;
  add_shared(command, Shared::kInProcess, &options.in_process);
  add_shared(command, Shared::kCallTimeout, &options.call_timeout_s)
      .fallback(source + format_double(defaults.call_timeout_s));
  add_shared(command, Shared::kMemoryLimit, &options.memory_limit_mib)
      .fallback(source + fmt::to_string(defaults.memory_mib));
}

}  // namespace

void add_limit_options(Command& command, IsolationOptions& options) {
  add_limits(command, options, "");
}

void add_isolation_options(Command& command, IsolationOptions& options, bool from_scenario) {
  const std::string source = from_scenario ? "the scenario's, else " : "";
  add_limits(command, options, source);
  add_shared(command, Shared::kOnFailure, &options.on_failure).fallback(source + "stop");
}

host::PluginLimits apply(const IsolationOptions& options, host::PluginLimits limits) {
  if (options.call_timeout_s) limits.call_timeout_s = *options.call_timeout_s;
  if (options.memory_limit_mib) limits.memory_mib = *options.memory_limit_mib;
  if (options.on_failure) {
    const auto at = std::ranges::find(host::kOnFailure, *options.on_failure);
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

std::vector<std::string> arguments_of(const IsolationOptions& options) {
  std::vector<std::string> arguments;
  if (options.in_process) arguments.emplace_back("--in-process");
  if (options.call_timeout_s)
    arguments.insert(arguments.end(), {"--call-timeout", format_double(*options.call_timeout_s)});
  if (options.memory_limit_mib)
    arguments.insert(arguments.end(), {"--memory-limit", fmt::to_string(*options.memory_limit_mib)});
  if (options.on_failure) arguments.insert(arguments.end(), {"--on-failure", *options.on_failure});
  return arguments;
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
