// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "map/document.hpp"
#include "map/robot_shape.hpp"

namespace hallway::map {

/// A key of a robot file, as text, and where it is.
struct RobotKey {
  std::string key{};
  std::string value{};
  int line = 0;
};

/// Keys of one sensor.
struct RobotSensor {
  std::string name{};
  std::vector<RobotKey>
      keys{};  ///< with `position_m`, the mount, which is the entity's `origin`, of those that have one; without `name`
  int line = 0;
};

/// What a robot file says: a map whose worldspawn has `_hallway_robot 1`. The map's origin is that of the body's frame; x forward, y left,
/// z up.
struct RobotFile {
  std::string file{};  ///< as it was given
  RobotBody body{};
  std::vector<BumpZone> zones{};
  std::vector<RobotKey> robot{};  ///< step_m, ledge_m, slope_deg, clearance_m, ledges, contact: of `hw_drive`
  bool has_drive = false;         ///< whether there is an `hw_drive`
  int drive_line = 0;             ///< of that
  std::vector<RobotKey> drive{};  ///< all other keys of `hw_drive`, by the names of entity_schema.hpp
  std::vector<RobotSensor> sensors{};  ///< in the order of the file
};

/// Whether worldspawn has `_hallway_robot 1`.
bool is_robot_file(const Document& document);

/// Whether a key of `hw_drive` is of the robot and not of its drive: RobotFile::robot has it.
bool is_key_of_robot(std::string_view key);

/// Throws Error{kBadInput} if the document is a robot file: for those who need a world.
void require_world(const Document& document);

/// Throws Error{kBadInput} with file, line and cause for a document that is no robot file or that has an error: in its body, zones, sensors or
/// drive, and for entities of a world.
RobotFile read_robot(const Document& document);

/// Loads and reads a file. Throws as load() and read_robot() do.
RobotFile load_robot_file(const std::filesystem::path& file);

}  // namespace hallway::map
