// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/planar_motion.hpp"
#include "sim/setting.hpp"
#include "sim/table_reader.hpp"

namespace hallway::sim {

/// What may happen to a robot, whatever it and its plugins do.
enum class EventKind {
  kKidnap,         ///< it is carried to another place and put down, at rest
  kSensorOff,      ///< a sensor gives no readings from now on
  kSensorOn,       ///< it gives readings again
  kPush,           ///< a twist is added to its own for a while; its wheels slip
  kWheelsBlocked,  ///< its wheels stand still for a while, and it with them
};

/// An event of a scenario.
struct EventSpec {
  std::int64_t t_ns = 0;
  EventKind kind = EventKind::kKidnap;
  std::string to{};               ///< kidnap: name of an `hw_robot_start`; empty: `place_m`
  std::optional<Vec3> place_m{};  ///< kidnap: world frame; the robot comes down from there to its floor
  double yaw_rad = 0.0;           ///< kidnap to `place_m`
  std::string sensor{};           ///< sensor_off, sensor_on
  PlanarTwist twist{};            ///< push: in the body's frame
  std::int64_t duration_ns = 0;   ///< push, wheels_blocked
  int line = 0;                   ///< of its table
};

/// Its name in scenarios and tables.
std::string_view event_kind_name(EventKind kind);

/// What it does, for people: one line without commas, such as the name of a sensor.
std::string text_of(const EventSpec& event);

/// Whether it acts on the drive or the body, so that the robot needs a drive.
bool acts_on_drive(EventKind kind);

/// Reads an [[event]]. Throws Error as TableReader does, and for keys that do not belong to its kind.
/// @param prefix  name of the table for messages
EventSpec read_event(const std::string& file, const std::string& prefix, const TomlTable& table, int line,
                     std::vector<Setting>& settings);

}  // namespace hallway::sim
