// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "map/robot_file.hpp"
#include "sim/scenario.hpp"

namespace hallway::cli {

/// A value of a robot and where it comes from.
struct RobotSetting {
  std::string table;  ///< robot, drive, or sensor.NAME
  std::string key;
  std::string value;
  std::string origin;  ///< "--set", "scenario line N", "robot file line N", "map line N" or "default"
};

/// What a robot file says, and then the defaults of its drive and sensors.
std::vector<RobotSetting> settings_of(const map::RobotFile& robot);

/// What a scenario says of its robot, drive and sensors, or its robot file, or its map where they have no sensors, and then the defaults. Loads the map where
/// its sensors count. Throws as map::load() and sim::take_map_sensors() do.
std::vector<RobotSetting> settings_of(sim::Scenario scenario);

/// "robot file line 7".
std::string robot_file_line(int line);

/// The unit that the end of a key's name says; empty where it says none.
std::string_view unit_of(std::string_view key);

}  // namespace hallway::cli
