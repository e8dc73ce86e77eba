// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/driven_spec.hpp"
#include "sim/setting.hpp"
#include "sim/table_reader.hpp"

namespace hallway::sim {

/// The keys of [robot] that need a [robot.drive].
extern const std::vector<std::string> kDrivenKeys;
/// The keys of [robot.drive]; those of kDisturbances are tables with the keys of kDisturbanceKeys.
extern const std::vector<std::string> kDriveKeys;
extern const std::vector<std::string> kDisturbances;
extern const std::vector<std::string> kDisturbanceKeys;

/// Where tables stand, and where their settings are noted.
struct DriveTables {
  std::filesystem::path scenario;  ///< names of files are relative to its folder
  std::string file;                ///< for messages
  std::vector<Setting>& settings;
  std::optional<std::size_t> kind{};  ///< of a drive that names none; none: it must name one
};

/// Reads what [robot] and its table `drive` say of a robot with a drive. What is not said is not noted as a setting. Throws Error as TableReader does, and for
/// values that do not fit each other.
/// @param has_path  whether the robot has a path
DrivenSpec read_driven(TableReader& robot, const DriveTables& tables, bool has_path);

/// Throws Error{kBadInput} for a key that needs a drive.
void refuse_driven_keys(const TableReader& robot);

}  // namespace hallway::sim
