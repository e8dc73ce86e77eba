// SPDX-License-Identifier: MIT
#pragma once

#include "command_line.hpp"
#include "console.hpp"

namespace hallway::cli {

// The options that several commands have. Each is one row of one table (shared_options.cpp): one name, one value, one meaning in every command of
// both programs, which a test checks. A new option that several commands take is a new row here and add_shared() in each of them.

/// A row of the table.
enum class Shared {
  kPlugin,       ///< --plugin NAME|FILE[:KEY=VALUE,...]: plugin_argument.hpp reads it
  kSet,          ///< --set KEY=VALUE, where there is a scenario or a configuration
  kSetPlugin,    ///< --set KEY=VALUE, where there are plugins alone
  kSetScenario,  ///< --set KEY=VALUE, where there is a scenario alone
  kPluginPath,
  kInProcess,
  kCallTimeout,
  kMemoryLimit,
  kOnFailure,
  kOutFolder,  ///< --out DIR
  kOutFile,    ///< --out FILE
  kOutLog,     ///< --out FILE|DIR
  kForce,
  kSeed,
  kFirstSeed,
  kSteps,
  kThreads,
  kJobs,
  kRepeat,
  kStrict,
  kRenderer,  ///< through add_renderer_option()
  kFoxglove,
  kView,
  kPicture,
  kLevel,
  kRate,
  kPeriod,
  kTruePoses,
  kTrueLandmarks,
  kJson,
  kQuiet,
};

/// Adds that option with its name, value, help and limits. What may differ between commands is said of what is returned: whether it is required or
/// may be repeated, and what counts without it.
Option& add_shared(Command& command, Shared which, Target target);

/// Adds --force, --json and --quiet.
void add_output_options(Command& command, OutputOptions& options);

}  // namespace hallway::cli
