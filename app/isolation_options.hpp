// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "base/setting.hpp"
#include "command_line.hpp"
#include "host/isolate/isolation.hpp"
#include "host/plugin_limits.hpp"

namespace hallway::cli {

/// How plugins are run, as the command line says it; what it does not say is unset.
struct IsolationOptions {
  bool in_process = false;
  std::optional<double> call_timeout_s;
  std::optional<std::uint64_t> memory_limit_mib;
  std::optional<std::string> on_failure;
};

/// Adds --in-process, --call-timeout and --memory-limit, for commands without a scenario: what is not given is host::PluginLimits' own.
void add_limit_options(Command& command, IsolationOptions& options);

/// The same and --on-failure.
/// @param from_scenario  whether a scenario may have the limits that are not given
void add_isolation_options(Command& command, IsolationOptions& options, bool from_scenario = true);

/// `limits` with what the command line says above them.
host::PluginLimits apply(const IsolationOptions& options, host::PluginLimits limits);

/// The same as settings of a scenario.
std::vector<Override> overrides_of(const IsolationOptions& options);

/// The same as arguments of another command that takes them.
std::vector<std::string> arguments_of(const IsolationOptions& options);

/// How plugins are kept within these limits; unset with --in-process. Their scratch folders stand in the system's folder for temporary files.
std::optional<host::Isolation> isolation_of(const IsolationOptions& options,
                                            const host::PluginLimits& limits);

/// For libraries that are only asked what is in them: with less time than a plugin that is run.
host::Isolation listing_isolation();

}  // namespace hallway::cli
