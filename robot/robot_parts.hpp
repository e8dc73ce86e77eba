// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "base/table_reader.hpp"
#include "host/load/driver.hpp"

namespace hallway::robot {

/// What a configuration says of the robot's drive and body. It overrides what the driver says, number by number.
struct RobotParts {
  std::optional<std::uint32_t> drive_kind{};  ///< HW_DRIVE_…
  host::DriveInfo drive{};                    ///< a number that is not set is NaN; not its kind
  host::BodyInfo body{};                      ///< likewise; a radius or corners replace both
  Where body_where{};                         ///< of the table, for messages
};

/// The keys of [drive] and [body].
const std::vector<std::string>& drive_part_keys();
extern const std::vector<std::string> kBodyPartKeys;

/// Reads the two tables. Throws Error as TableReader does, and for keys of [body] that do not fit each other.
RobotParts read_robot_parts(TableReader& drive, TableReader& body);

/// Sets them above what the driver says; a robot of which it says nothing gets a drive or a body where one is set. Throws Error{kBadInput} where the body has
/// its bottom above its top then.
void override_parts(const RobotParts& parts, host::RobotInfo& robot);

}  // namespace hallway::robot
