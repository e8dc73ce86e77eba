// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace hallway {

/// One effective setting of a run, for its record.
struct Setting {
  std::string key;    ///< as `--set` takes it, e.g. "sensor.eyes.noise_m"; list members as "picture[1].file"
  std::string value;  ///< numbers as shortest round-trip decimals, texts without quotes
  std::string
      origin;  ///< "office.toml:12" (name of the file without its folder), "default" or "command line"
};

/// A setting given on the command line; it stands above the file.
struct Override {
  std::string key;  ///< e.g. "seed", "robot.speed_m_s", "sensor.eyes.noise_m", "slam_point.noise_m", "plugin"
  std::string value;  ///< a TOML value; what is none is taken as text
};

}  // namespace hallway
