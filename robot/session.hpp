// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "host/isolate/isolation.hpp"
#include "host/stage.hpp"
#include "robot/config.hpp"
#include "robot/loop.hpp"

namespace hallway::robot {

/// Where drivers and plugins are found, and how plugins run.
struct Surroundings {
  std::vector<std::filesystem::path> driver_folders;
  std::vector<std::filesystem::path> plugin_folders;
  std::optional<host::Isolation> isolation{};  ///< unset: in this process
  host::LogSink log{};
};

/// How long what may take, by configuration and robot.
struct Timing {
  Clock::duration watchdog{};                 ///< 0: the clock stops nothing
  std::optional<Clock::duration> tick{};      ///< of the schedule
  std::optional<Clock::duration> deadline{};  ///< of an answer
  std::int64_t period_ns = 0;                 ///< from frame to frame; 0 where it is not known
  std::vector<std::string> warnings{};        ///< what the configuration asks for and the robot does not have
};

/// The watchdog's time is the configuration's, else two periods and 50 ms at least, 500 ms where no period is known. In lock-step the
/// clock counts for nothing.
Timing timing_of(const Config& config, const host::RobotInfo& robot);

/// What one run leaves, and where.
struct SessionPlan {
  std::filesystem::path folder;  ///< final name of the run folder
  bool replace = false;          ///< an earlier run of that name may be replaced
  std::optional<std::chrono::nanoseconds> duration{};
};

struct SessionHooks {
  std::function<void(int wake)>
      started;  ///< the watchdog runs; `wake` is its eventfd, to be counted up when `stop` changes
  std::function<bool()> stop;  ///< true ends the run in good order; asked by several threads
  std::function<void(const std::string& message)> notice;  ///< a warning, as it comes
};

/// How a run went.
struct SessionResult {
  std::vector<std::string> plugins;  ///< "slam_point 0.1.0"
  nlohmann::ordered_json manifest;   ///< run.json
  record::Failures failures;
  std::uint64_t landmarks = 0;  ///< with the status mapped
  std::uint64_t planes = 0;     ///< of the map
  std::uint64_t submaps = 0;
  LoopEnd end = LoopEnd::kDriver;
  std::optional<Error> driver_failure;  ///< the driver's, which ended the run
};

/// Runs a robot until it ends, and writes the run folder (docs/formats.md), which appears whole or not at all. Throws what is wrong before the
/// first frame, and Error{kIo} if the folder cannot be written.
SessionResult run_session(const Config& config, const Surroundings& surroundings, const SessionPlan& plan,
                          const SessionHooks& hooks);

}  // namespace hallway::robot
