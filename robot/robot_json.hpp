// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "robot/session.hpp"

namespace hallway::robot {

/// Parts of run.json that only a robot's has (docs/formats.md).

/// The driver: id, version, hash of its file, settings. Throws Error{kIo} if the file cannot be read.
nlohmann::ordered_json print_driver(const Config& config, const host::Driver& driver);
nlohmann::ordered_json print_sensors(const host::RobotInfo& robot);
nlohmann::ordered_json print_limits(const host::PluginLimits& limits);

/// "driver", "duration", "interrupt", "plugin": who ended it.
std::string loop_end_name(LoopEnd end);

/// What is known of a robot's run at its end.
struct RobotFacts {
  const host::RobotInfo& robot;
  const Timing& timing;
  const Loop& loop;
  GateCounts gate{};
  std::uint64_t unrecorded = 0;
  const std::vector<host::Counter>& driver_counters;
  double command_timeout_s = 0;  ///< 0: a command holds until the next
  std::string end{};
};

/// The member `robot`; what the clock says stands in its member `timing`.
nlohmann::ordered_json print_robot(const RobotFacts& facts);

}  // namespace hallway::robot
