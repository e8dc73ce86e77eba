// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "console.hpp"
#include "host/pipeline.hpp"
#include "plugin_report.hpp"
#include "run/feed/run.hpp"
#include "watcher.hpp"

namespace hallway::cli {

/// What `run` and `replay` say at their end.
struct Report {
  std::string name;                   ///< of the scenario or log
  std::vector<std::string> warnings;  ///< already shown on standard error
};

/// "1 submap", "2 submaps".
std::string counted(std::uint64_t count, const char* thing);

/// Rows of what a robot that a drive moves did.
void add_drive(const Rows& row, const sim::DriveCounts& drive);

/// Runs a plan with a progress bar, ended in good order by Ctrl-C or SIGTERM, and prints the short table or the document.
/// @param watcher  is shown the run, instead of the bar; may be null
/// @return the exit status
int execute_and_report(run::Source& source, host::Pipeline& pipeline, const run::RunPlan& plan,
                       const Report& report, const OutputOptions& output, Watcher* watcher = nullptr);

}  // namespace hallway::cli
