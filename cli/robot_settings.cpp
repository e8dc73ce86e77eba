// SPDX-License-Identifier: MIT
#include "robot_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "base/origin.hpp"
#include "base/text.hpp"
#include "map/entity_schema.hpp"
#include "map/reader.hpp"
#include "sim/drive_keys.hpp"
#include "sim/sensors.hpp"

namespace hallway::cli {
namespace {

namespace fs = std::filesystem;
using Settings = std::vector<RobotSetting>;

bool has(const Settings& settings, const std::string& table, std::string_view key) {
  return std::ranges::any_of(
      settings, [&](const RobotSetting& setting) { return setting.table == table && setting.key == key; });
}

/// The defaults of what a table does not say.
void add_default(Settings& settings, const std::string& table, const map::KeySpec& key) {
  if (!key.fallback.empty() && !has(settings, table, key.name))
    settings.push_back({table, std::string(key.name), std::string(key.fallback), "default"});
}

void add_drive_defaults(Settings& settings) {
  for (const map::KeySpec& key : map::find_entity_spec("hw_drive")->keys)
    add_default(settings, map::is_key_of_robot(key.name) ? "robot" : "drive", key);
}

void add_sensor_defaults(Settings& settings, const std::string& table) {
  const map::EntitySpec& spec = *map::find_entity_spec("hw_sensor");
  std::string kind(spec.key("kind")->fallback);
  for (const RobotSetting& setting : settings) {
    if (setting.table == table && setting.key == "mounted" && setting.value == "false") return;
    if (setting.table == table && setting.key == "kind") kind = setting.value;
  }
  for (const map::KeySpec& key : spec.keys) {
    if (map::belongs(key, kind)) add_default(settings, table, key);
  }
}

/// Rows of one table beside each other, in the order in which the tables begin; the robot and the drive first.
void put_in_order(Settings& settings) {
  std::vector<std::string> tables{"robot", "drive"};
  for (const RobotSetting& setting : settings) {
    if (std::ranges::find(tables, setting.table) == tables.end()) tables.push_back(setting.table);
  }
  std::ranges::stable_sort(settings, {}, [&](const RobotSetting& setting) {
    return std::ranges::find(tables, setting.table) - tables.begin();
  });
}

std::vector<std::string> sensor_tables(const Settings& settings) {
  std::vector<std::string> tables;
  for (const RobotSetting& setting : settings) {
    if (setting.table.starts_with("sensor.") && std::ranges::find(tables, setting.table) == tables.end())
      tables.push_back(setting.table);
  }
  return tables;
}

/// What "cart.map:7" means in a scenario.
std::string origin_text(const std::string& origin, const sim::Scenario& scenario, bool of_map) {
  if (origin == kCommandLine) return "--set";
  const std::size_t colon = origin.rfind(':');
  if (colon == std::string::npos) return origin;
  const std::string line = origin.substr(colon + 1);
  if (of_map) return "map line " + line;
  const auto name_of = [](const fs::path& file) { return printable(file.filename().string()); };
  const bool of_file = !scenario.robot_file.empty() &&
                       origin.substr(0, colon) == name_of(scenario.robot_file) &&
                       name_of(scenario.robot_file) != name_of(scenario.file);
  return (of_file ? "robot file line " : "scenario line ") + line;
}

/// The table and the key of "robot.drive.left_slip.mean" and others; an empty table for what is not the robot's.
std::pair<std::string, std::string> place_of(const std::string& key) {
  const std::string drive = "robot.drive.", robot = "robot.", sensor = "sensor.";
  if (key.starts_with(drive)) {
    std::string rest = key.substr(drive.size());
    std::ranges::replace(rest, '.', '_');
    return {"drive", rest};
  }
  if (key.starts_with(robot)) return {"robot", key.substr(robot.size())};
  const std::size_t dot = key.rfind('.');
  if (key.starts_with(sensor)) return {key.substr(0, dot), key.substr(dot + 1)};
  return {};
}

}  // namespace

std::string robot_file_line(int line) {
  return fmt::format("robot file line {}", line);
}

Settings settings_of(const map::RobotFile& robot) {
  Settings settings;
  const auto add = [&](const std::string& table, const std::vector<map::RobotKey>& keys) {
    for (const map::RobotKey& key : keys)
      settings.push_back({table, key.key, key.value, robot_file_line(key.line)});
  };
  add("robot", robot.robot);
  add("drive", robot.drive);
  if (robot.has_drive) add_drive_defaults(settings);
  for (const map::RobotSensor& sensor : robot.sensors) {
    add("sensor." + sensor.name, sensor.keys);
    add_sensor_defaults(settings, "sensor." + sensor.name);
  }
  put_in_order(settings);
  return settings;
}

Settings settings_of(sim::Scenario scenario) {
  const std::size_t own = scenario.settings.size();
  if (scenario.takes_map_sensors) sim::take_map_sensors(scenario, map::load(scenario.map_file));
  Settings settings;
  for (std::size_t i = 0; i < scenario.settings.size(); ++i) {
    const Setting& setting = scenario.settings[i];
    const auto [table, key] = place_of(setting.key);
    if (!table.empty())
      settings.push_back({table, key, setting.value, origin_text(setting.origin, scenario, i >= own)});
  }
  if (scenario.robot.driven) add_drive_defaults(settings);
  for (const std::string& table : sensor_tables(settings)) add_sensor_defaults(settings, table);
  put_in_order(settings);
  return settings;
}

std::string_view unit_of(std::string_view key) {
  using Unit = std::pair<std::string_view, std::string_view>;
  static constexpr std::array<Unit, 9> kUnits{{{"_rad_s2", "rad/s2"},
                                               {"_m_s2", "m/s2"},
                                               {"_rad_s", "rad/s"},
                                               {"_m_s", "m/s"},
                                               {"_rad", "rad"},
                                               {"_deg", "deg"},
                                               {"_hz", "Hz"},
                                               {"_m", "m"},
                                               {"_s", "s"}}};
  if (key.find("_per_") != std::string_view::npos) return {};
  const auto found =
      std::ranges::find_if(kUnits, [&](const Unit& unit) { return key.ends_with(unit.first); });
  return found == kUnits.end() ? std::string_view() : found->second;
}

}  // namespace hallway::cli
