// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "host/pipeline.hpp"
#include "host/plugin_limits.hpp"
#include "host/verdict.hpp"

namespace hallway::record {

/// A failure of the pipeline.
struct Failure {
  host::Verdict verdict;
  std::optional<std::uint32_t> iteration;  ///< of its frame; unset where it was no call of process()
};

/// What became of `work` that calls plugins: the verdict on the one that failed, or nothing. Lets errors pass that are no misdeed of a plugin.
std::optional<host::Verdict> verdict_of(const std::function<void()>& work);

/// How often in a row plugins are started that fail while they are loaded or activated.
inline constexpr std::uint32_t kStartAttempts = 3;

/// Starts the plugins of a pipeline, anew where it has been started: once or, with kRestart, up to kStartAttempts times.
/// @return the failures, as many as there were attempts where pipeline.started() is false in the end
/// Throws what is no misdeed of a plugin: that one cannot be loaded, or refuses its parameters or sensors.
std::vector<Failure> start_plugins(host::Pipeline& pipeline, host::OnFailure policy);

}  // namespace hallway::record
