// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/sensor_info.hpp"

namespace hallway::cli {

/// Which sensor an option names, or which one there is.
struct SensorQuestion {
  const char* option;
  std::vector<std::uint32_t>
      kinds;         ///< that it may give; without a name the first of which there is a sensor
  const char* what;  ///< "rays or points"
};

/// The sensor of that name. Throws Error{kUsage} naming those of the log if there is none.
const host::SensorInfo& find_named_sensor(const std::vector<host::SensorInfo>& sensors,
                                          const std::string& name);

/// The sensor that an option names; where it names none, the only one. Throws Error{kUsage} for one that there is not or of another kind, and where there are
/// several; Error{kBadInput} where there is none.
const host::SensorInfo& find_sensor(const std::vector<host::SensorInfo>& sensors, const std::string& name,
                                    const SensorQuestion& question);

}  // namespace hallway::cli
