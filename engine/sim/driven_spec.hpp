// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "drive/spec.hpp"

namespace hallway::sim {

/// Who gives the commands that a drive obeys.
enum class DrivenBy { kPlugin, kPath, kCommands };

/// A robot with a drive and a body that meets what stands in its way. Lengths in metres, angles in radians.
struct DrivenSpec {
  drive::DriveSpec drive{};
  DrivenBy by = DrivenBy::kPlugin;
  std::string plugin{};  ///< by kPlugin: the id of the one that drives; empty: the only one that can
  std::filesystem::path
      commands{};  ///< by kCommands: as read_commands() reads it, usable from the current folder
  std::int64_t watchdog_ns = 200'000'000;  ///< how long the last command holds after a failure of the plugins
  std::int64_t command_timeout_ns = 0;     ///< how long it holds when no new one comes; 0: until the next one
  double look_ahead_m = 0.5;               ///< by kPath: of the pursuit
  double clearance_m = 0.03;               ///< of the body's bottom above the plane of the wheels
  double step_m = 0.025;                   ///< greatest step that a wheel climbs
  double ledge_m = 0.025;                  ///< greatest step that a wheel goes down
  double slope_rad = 0.35;                 ///< greatest tilt of the body
  bool falls = false;  ///< true: it drives over ledges; false: a ledge stops it as a wall does
  bool slides = true;  ///< along what it touches; false: it stops there
};

}  // namespace hallway::sim
