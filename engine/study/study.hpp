// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/isolate/isolation.hpp"
#include "host/stage.hpp"
#include "study/chart.hpp"
#include "study/ground.hpp"
#include "study/plan.hpp"
#include "study/table.hpp"
#include "study/trace.hpp"

namespace hallway::study {

/// A run and what it gave.
struct StudyRun {
  RunSpec spec{};
  Trace trace{};
};

/// What a study comes to.
struct Outcome {
  std::vector<Table> tables{};
  std::vector<Chart> charts{};
};

/// One of the evaluations of the thesis (6.5 to 6.9).
struct Study {
  std::string_view name{};
  std::string_view figures{};  ///< of the thesis
  std::string_view about{};    ///< one sentence
  std::string_view size{};     ///< what the full size is
  /// Runs of one ground follow each other.
  std::vector<RunSpec> (*plan)(const Request&) = nullptr;
  Outcome (*conclude)(const std::vector<StudyRun>&, const Request&) = nullptr;
};

/// All studies, in the order of the thesis.
std::span<const Study> studies();

/// The plugins of a study where none are given.
std::vector<PluginChoice> default_plugins(const Study& study);

/// How runs are made.
struct RunnerSetup {
  Folders folders{};
  std::filesystem::path data{};
  unsigned threads = 1;  ///< of the simulator
  std::vector<std::filesystem::path> plugin_folders{};
  std::optional<host::Isolation> isolation{};  ///< unset: in this process
  host::LogSink log{};
  std::function<void(std::uint64_t done)> progress{};  ///< iterations of all runs
  std::function<bool()> stop{};
};

/// Makes the runs, one after the other, so that times are fair. Ends early where it is asked to stop; the last run is then
/// Trace::stopped. Throws what make_ground() throws, and Error{kPluginLoad, kBadInput} for a plugin that cannot be loaded or refuses its parameters.
std::vector<StudyRun> make_runs(const std::vector<RunSpec>& specs, const RunnerSetup& setup);

/// The tables that every study has: `runs` and `curves` without times, `times` and `times_curves` with the facts of clock and machine.
std::vector<Table> common_tables(const std::vector<StudyRun>& runs);

/// Writes the tables as CSV, the charts as SVG and PNG, and all of it as study.json (schema `hallway.study/1`) into a folder.
/// @return the document  Throws Error{kIo}.
nlohmann::ordered_json write_outcome(const Study& study, const Request& request, const Outcome& outcome,
                                     const std::filesystem::path& folder);

}  // namespace hallway::study
