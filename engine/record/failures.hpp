// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "host/isolate/verdict.hpp"
#include "host/pipeline.hpp"
#include "host/plugin_limits.hpp"

namespace hallway::record {

/// A failure of the pipeline.
struct Failure {
  host::Verdict verdict;
  std::optional<std::uint32_t> iteration;  ///< of its frame; unset where it was no call of process()
};

/// How often a pipeline failed in a run, and how.
struct Failures {
  std::uint64_t count = 0;
  std::vector<Failure> verdicts;  ///< of the first of them, kMaxVerdicts at most
  std::uint64_t restarts = 0;

  static constexpr std::size_t kMaxVerdicts = 100;

  void note(host::Verdict verdict, std::optional<std::uint32_t> iteration);
};

/// Calls `work`. @return the verdict where a plugin failed in it; what else it throws goes on
std::optional<host::Verdict> catch_failure(const std::function<void()>& work);

/// How often in a row plugins are started that fail while they are loaded or activated.
inline constexpr std::uint32_t kStartAttempts = 3;

/// Starts the plugins of a pipeline, anew where it has been started: once or, with kRestart, up to kStartAttempts times.
/// @return the failures, as many as there were attempts where pipeline.started() is false in the end
/// Throws what is no misdeed of a plugin: that one cannot be loaded, or refuses its parameters or sensors.
std::vector<Failure> start_plugins(host::Pipeline& pipeline, host::OnFailure policy);

/// Adds to run.json what became of the plugins: on_failure, verdict (null: nothing), and of several failures all.
void describe_failures(host::OnFailure policy, const Failures& failures, nlohmann::ordered_json& manifest);

}  // namespace hallway::record
