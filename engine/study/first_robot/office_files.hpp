// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "map/document.hpp"
#include "study/first_robot/office.hpp"

namespace hallway::study {

/// The office as a map: one solid block out of which hallways, rooms and doorways are cut, and the cabinets. 1 cm per unit.
map::Document office_map(const Office& office);

/// What the tracks and sensors of the robot do.
enum class OfficeFaults {
  kNone,
  /// 2 % of the readings of infrared detectors false and 2 % missed, their range off by 5 % (one sigma); tracks that lose 25 +- 10 % of a turn; a sonar with
  /// specular loss and false echoes.
  kUsual,
};

/// A scenario in which wall_follower maps an office at 20 Hz.
/// @param about  the lines of the comment that it begins with
/// @param map, robot  names of files, relative to the scenario's folder
std::string office_scenario(const std::vector<std::string>& about, const std::string& map,
                            const std::string& robot, OfficeFaults faults);

/// Writes NAME.map, NAME.toml, NAME_faults.toml, and NAME_robot.map, a copy of the robot file, so that they may be moved together. The same seed and robot
/// give the same bytes. Throws Error{kIo}: where one cannot be written, all files stay as they were.
/// @param map  the path of NAME.map
/// @return the files, in this order
std::vector<std::filesystem::path> write_office(std::uint64_t seed, const std::filesystem::path& map,
                                                const std::filesystem::path& robot);

/// The files that write_office() writes.
std::vector<std::filesystem::path> office_files(const std::filesystem::path& map);

}  // namespace hallway::study
