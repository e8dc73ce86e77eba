// SPDX-License-Identifier: MIT
#include "sim/drive_keys.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "host/plugin_table.hpp"
#include "map/entity_schema.hpp"

namespace hallway::sim {
namespace {

constexpr Range kLookAhead_m{0.001, 100.0};
constexpr Range kHold_s{0.0, 3600.0};

/// What keys may be that robot files have too stands in the classes of maps.
Range range_of(const std::string& key) {
  const map::KeySpec& spec = map::entity_key("hw_drive", key);
  return {spec.low, spec.high, spec.above_low};
}

std::int64_t to_ns(double seconds) {
  return std::llround(seconds * 1e9);
}

/// Reads keys that may be left out without being noted.
struct DriveReader {
  TableReader& table;
  std::string prefix{};  ///< of the keys in robot files

  void number(const std::string& key, double& value) {
    if (table.has(key)) value = table.number(key, range_of(prefix + key));
  }
  void number(const std::string& key, std::optional<double>& value) {
    if (table.has(key)) value = table.number(key, range_of(prefix + key));
  }
  void seconds(const std::string& key, std::int64_t& value_ns) {
    if (table.has(key)) value_ns = to_ns(table.number(key, range_of(prefix + key)));
  }
};

drive::Disturbance read_disturbance(const TableReader& drive, const DriveTables& tables,
                                    const std::string& key) {
  drive::Disturbance disturbance;
  if (!drive.has(key)) return disturbance;
  TableReader table(drive.file(key), "robot.drive." + key, drive.table(key), drive.line(key),
                    kDisturbanceKeys, tables.settings);
  DriveReader keys{table, key + "_"};
  keys.number("mean", disturbance.mean);
  keys.number("sigma", disturbance.sigma);
  keys.seconds("correlation_s", disturbance.correlation_ns);
  return disturbance;
}

/// @param kind  where the table has none; none: it must have one
drive::DriveSpec read_drive(TableReader& table, const DriveTables& tables,
                            const std::optional<std::size_t>& kind) {
  static const std::vector<std::string> kinds(drive::kDriveKindNames.begin(), drive::kDriveKindNames.end());
  drive::DriveSpec spec;
  spec.kind = static_cast<drive::DriveKind>(table.choice("kind", kinds, kind));
  DriveReader keys{table};
  keys.number("wheel_base_m", spec.wheel_base_m);
  keys.number("axle_distance_m", spec.axle_distance_m);
  keys.number("wheel_radius_m", spec.wheel_radius_m);
  keys.number("greatest_steering_rad", spec.greatest_steering_rad);
  keys.number("max_steering_rate_rad_s", spec.max_steering_rate_rad_s);
  keys.number("max_speed_m_s", spec.max_speed_m_s);
  keys.number("max_lateral_m_s", spec.max_lateral_m_s);
  keys.number("max_angular_rad_s", spec.max_angular_rad_s);
  keys.number("max_acceleration_m_s2", spec.max_acceleration_m_s2);
  keys.number("max_deceleration_m_s2", spec.max_deceleration_m_s2);
  keys.number("max_angular_acceleration_rad_s2", spec.max_angular_acceleration_rad_s2);
  keys.seconds("latency_s", spec.latency_ns);
  keys.number("dead_band_m_s", spec.dead_band_m_s);
  keys.number("dead_band_rad_s", spec.dead_band_rad_s);
  keys.number("turn_slip", spec.turn_slip);
  keys.number("turn_slip_noise", spec.turn_slip_noise);
  spec.forward_noise = read_disturbance(table, tables, "forward_noise");
  spec.angular_noise = read_disturbance(table, tables, "angular_noise");
  spec.lateral_drift = read_disturbance(table, tables, "lateral_drift");
  spec.left_slip = read_disturbance(table, tables, "left_slip");
  spec.right_slip = read_disturbance(table, tables, "right_slip");
  try {
    drive::check(spec);
  } catch (const Error& error) {
    throw table.error("kind", "is refused: " + std::string(error.what()));
  }
  return spec;
}

DrivenBy read_driver(TableReader& robot, bool has_path) {
  static const std::vector<std::string> drivers{"plugin", "path", "commands"};  // in the order of DrivenBy
  std::size_t by = 0;
  if (robot.has("driven_by")) {
    by = robot.choice("driven_by", drivers);
  } else if (robot.has("commands")) {
    by = 2;
  } else if (has_path && !robot.has("driving_plugin")) {
    by = 1;
  }
  const auto driver = static_cast<DrivenBy>(by);
  if (driver == DrivenBy::kPath && !has_path)
    throw robot.error("path", "is missing; the robot is driven by it");
  if ((driver == DrivenBy::kCommands) != robot.has("commands")) {
    throw robot.error("commands", driver == DrivenBy::kCommands ? "is missing; the robot is driven by them"
                                                                : "needs driven_by = \"commands\"");
  }
  if (robot.has("driving_plugin") && driver != DrivenBy::kPlugin)
    throw robot.error("driving_plugin", "needs driven_by = \"plugin\"");
  return driver;
}

}  // namespace

const std::vector<std::string> kDrivenKeys{"driven_by",         "driving_plugin", "commands",    "watchdog_s",
                                           "command_timeout_s", "look_ahead_m",   "clearance_m", "ledges",
                                           "contact",           "step_m",         "ledge_m",     "slope_deg"};
const std::vector<std::string> kDriveKeys{"kind",
                                          "wheel_base_m",
                                          "axle_distance_m",
                                          "wheel_radius_m",
                                          "greatest_steering_rad",
                                          "max_steering_rate_rad_s",
                                          "max_speed_m_s",
                                          "max_lateral_m_s",
                                          "max_angular_rad_s",
                                          "max_acceleration_m_s2",
                                          "max_deceleration_m_s2",
                                          "max_angular_acceleration_rad_s2",
                                          "latency_s",
                                          "dead_band_m_s",
                                          "dead_band_rad_s",
                                          "turn_slip",
                                          "turn_slip_noise",
                                          "forward_noise",
                                          "angular_noise",
                                          "lateral_drift",
                                          "left_slip",
                                          "right_slip"};
const std::vector<std::string> kDisturbances{"forward_noise", "angular_noise", "lateral_drift", "left_slip",
                                             "right_slip"};
const std::vector<std::string> kDisturbanceKeys{"mean", "sigma", "correlation_s"};

DrivenSpec read_driven(TableReader& robot, const DriveTables& tables, bool has_path) {
  DrivenSpec spec;
  TableReader drive(robot.file("drive"), "robot.drive", robot.table("drive"), robot.line("drive"), kDriveKeys,
                    tables.settings);
  spec.drive = read_drive(drive, tables, tables.kind);
  spec.by = read_driver(robot, has_path);
  if (robot.has("driving_plugin")) spec.plugin = robot.text("driving_plugin");
  if (robot.has("commands"))
    spec.commands = host::beside(tables.scenario, robot.text("commands"), robot.line("commands"));
  DriveReader keys{robot};
  if (robot.has("watchdog_s")) spec.watchdog_ns = to_ns(robot.number("watchdog_s", kHold_s));
  if (robot.has("command_timeout_s"))
    spec.command_timeout_ns = to_ns(robot.number("command_timeout_s", kHold_s));
  if (robot.has("look_ahead_m")) spec.look_ahead_m = robot.number("look_ahead_m", kLookAhead_m);
  keys.number("clearance_m", spec.clearance_m);
  keys.number("step_m", spec.step_m);
  keys.number("ledge_m", spec.ledge_m);
  if (robot.has("slope_deg"))
    spec.slope_rad = robot.number("slope_deg", range_of("slope_deg")) * std::numbers::pi / 180.0;
  static const std::vector<std::string> ledges{"contact", "fall"}, contacts{"slide", "stop"};
  if (robot.has("ledges")) spec.falls = robot.choice("ledges", ledges) == 1;
  if (robot.has("contact")) spec.slides = robot.choice("contact", contacts) == 0;
  return spec;
}

void refuse_driven_keys(const TableReader& robot) {
  for (const std::string& key : kDrivenKeys) {
    if (robot.has(key)) throw robot.error(key, "needs a [robot.drive]; without one the path moves the robot");
  }
}

}  // namespace hallway::sim
