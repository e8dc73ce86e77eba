// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/toml_node.hpp"
#include "map/robot_file.hpp"
#include "sense/bump_sensor.hpp"
#include "sim/scenario.hpp"

namespace hallway::sim {

/// The name of a robot file in the folder of a run.
inline constexpr const char* kCopyOfRobot = "robot.map";

/// A file that a scenario names: where it stands, or in the folder of a run, which has the scenario as it was, its copy under another name.
/// @param copy  that name
std::filesystem::path named_or_copy(const std::filesystem::path& scenario, const std::filesystem::path& named,
                                    const char* copy);

/// The file that `[robot] file` names, by the command line before the scenario; none where it names none, or something that is no text.
/// @param scenario  where the scenario stands
std::optional<std::filesystem::path> find_robot_file(const TomlTable& root,
                                                     std::span<const Override> overrides,
                                                     const std::filesystem::path& scenario);

std::vector<std::string> sensor_names(const map::RobotFile& robot);

/// Puts what a robot file says into a scenario, key by key where that says nothing. The sensors of the file come first, in its order.
///
/// A body of the scenario, a cylinder or a box, takes the place of one of another form; its `bottom_m` and `top_m` may be the file's. A body of the file
/// that is neither has no keys. Of a sensor or a drive whose kind the scenario says, only keys that this kind has are taken.
void take_robot_file(TomlTable& root, const map::RobotFile& robot);

/// The sensors of the file, in its order.
std::vector<SensorSpec> sensors_of(const map::RobotFile& robot);

/// The file's zones for bumpers. A zone that reaches to the end of the body has no end there: a contact at the very edge is in it.
std::vector<sense::BumpZone> bump_zones_of(const map::RobotFile& robot);

}  // namespace hallway::sim
