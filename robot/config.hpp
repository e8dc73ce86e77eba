// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/setting.hpp"
#include "host/load/driver.hpp"
#include "host/pipeline.hpp"
#include "host/plugin_limits.hpp"
#include "robot/robot_parts.hpp"

namespace hallway::robot {

/// Which driver a robot has, and what it is told.
struct DriverSpec {
  std::string name;                           ///< an id or a file, as host::find_driver() takes it
  std::vector<host::DriverSetting> settings;  ///< in the order of the file
};

/// What is to be run on a robot. A value; where each part of it came from stands in `settings`.
struct Config {
  std::string file;     ///< path as the user gave it
  std::string content;  ///< of the file
  DriverSpec driver;
  std::vector<host::StageSpec> pipeline;                ///< in the order of the file
  host::PluginLimits limits{.call_timeout_s = 10.0};    ///< shorter than a simulator's: a robot waits
  std::optional<std::chrono::milliseconds> watchdog{};  ///< unset: by the period
  std::optional<double> rate_hz{};                      ///< unset: as frames come
  std::size_t backlog = 8;                              ///< frames that may wait while the plugins are busy
  double report_every_s = 0.0;     ///< how often the map is asked for and given to the robot; 0: never
  double command_timeout_s = 0.0;  ///< how long a command holds when no new one comes; 0: until the next
  bool record = true;              ///< whether a log is written
  RobotParts parts{};              ///< of the drive and the body, above what the driver says
  std::vector<Setting> settings;   ///< every effective setting, in the order of the file

  /// A short name for titles: the file's, without folder and extension.
  std::string name() const { return std::filesystem::path(file).stem().string(); }
  /// What relative file names in the driver's settings are relative to.
  std::filesystem::path folder() const;
};

/// Reads a robot's configuration (format: docs/formats.md) and sets `overrides` above it: `driver` and `plugin`, wherever they stand, replace the
/// driver (its settings stay if it is the same one) and leave one plugin; then come `driver.KEY`, `drive.KEY`, `body.KEY`, `robot.KEY`, `limits.KEY` and `PLUGIN.parameter`.
/// Nothing is loaded.
/// Throws Error{kIo} if the file cannot be read; Error{kBadInput} with file, line and key for what is wrong in it; Error{kUsage} for an
/// override whose key is unknown or whose value is wrong.
Config load_config(const std::filesystem::path& file, std::span<const Override> overrides = {});

}  // namespace hallway::robot
