// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/driver.h>

#include <string>
#include <vector>

namespace hallway::host {

/// One setting that a driver knows.
struct DriverSettingInfo {
  std::string key;
  std::string help;  ///< what it means, with its default
};

/// What a driver says of itself, checked and copied. Texts are safe to print.
struct DriverInfo {
  std::string id;           ///< unique; letters, digits, _ - .
  std::string name;         ///< for people
  std::string version;      ///< the driver's own
  std::string vendor;       ///< who made it
  std::string description;  ///< one sentence
  std::vector<DriverSettingInfo> settings;

  /// The keys of the settings.
  std::vector<std::string> setting_keys() const;
};

/// Checks and copies what a driver says of itself. Throws Error{kPluginLoad} naming the member that is not as driver.h
/// says.
DriverInfo read_driver_info(const hw_driver_info_t* info);

}  // namespace hallway::host
