// SPDX-License-Identifier: MIT
#include "sim/overrides.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/origin.hpp"
#include "base/text.hpp"
#include "base/toml_reader.hpp"
#include "host/plugin_table.hpp"
#include "map/sensors.hpp"
#include "sim/drive_keys.hpp"
#include "sim/schema.hpp"

namespace hallway::sim {
namespace {

bool holds(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void remove_key(TomlTable& table, std::string_view key) {
  std::erase_if(table, [&](const TomlEntry& entry) { return entry.key == key; });
}

using SensorNames = std::span<const std::string>;

/// The names of the [sensor.NAME] tables, and more of them.
std::vector<std::string> names_of_sensors(const TomlTable& scenario, SensorNames more) {
  std::vector<std::string> names(more.begin(), more.end());
  const TomlNode* node = find(scenario, "sensor");
  const auto* sensors = node != nullptr ? std::get_if<TomlTable>(&node->value) : nullptr;
  if (sensors == nullptr) return names;
  for (const TomlEntry& sensor : *sensors) {
    if (std::holds_alternative<TomlTable>(sensor.node.value)) names.push_back(sensor.key);
  }
  return names;
}

/// Every key that could have been meant, for suggestions.
std::vector<std::string> settable_keys(TomlTable& scenario, SensorNames sensors, std::string_view wanted) {
  std::vector<std::string> keys = kTopOverrideKeys;
  keys.push_back("plugin");
  for (const std::vector<std::string>& known : {kRobotKeys, kDrivenKeys})
    for (const std::string& key : known) keys.push_back("robot." + key);
  for (const std::string& key : kDriveKeys) {
    if (!holds(kDisturbances, key)) keys.push_back("robot.drive." + key);
  }
  for (const std::string& disturbance : kDisturbances)
    for (const std::string& key : kDisturbanceKeys) keys.push_back("robot.drive." + disturbance + "." + key);
  for (const std::string& name : names_of_sensors(scenario, sensors)) {
    for (const map::KeySpec& key : map::kSensorKeys) {
      if (key.name != "name") keys.push_back("sensor." + name + "." + std::string(key.name));
    }
    keys.push_back("sensor." + name + "." + kMounted);
  }
  for (const std::string& key : kCloudKeys) keys.push_back("cloud.NAME." + key);
  for (std::string& key : host::plugin_parameter_keys(scenario, wanted)) keys.push_back(std::move(key));
  return keys;
}

[[noreturn]] void refuse(TomlTable& scenario, SensorNames sensors, const std::string& key) {
  std::string hint = suggestion(key, settable_keys(scenario, sensors, key));
  if (key.starts_with("sensor.") && names_of_sensors(scenario, sensors).empty())
    hint =
        "; its sensors are the map's, which `hallway edit MAP key` changes; a `[sensor.NAME]` of the "
        "scenario replaces them all";
  if (hint.empty() && key.find('.') == std::string::npos)
    hint = "; a parameter of one of the plugins is PLUGIN.KEY";
  throw Error(ErrorCode::kUsage, "the scenario has no such setting" + hint,
              {.file = kCommandLine, .element = "key `" + printable(key) + "`"});
}

void set_robot(TomlTable& scenario, const std::string& key, TomlNode value) {
  TomlTable* robot = table_in(scenario, "robot");
  if (robot == nullptr) return;  // the reader says what is wrong there
  assign(*robot, key, std::move(value));
  if (key == "speed_m_s") remove_key(*robot, "loop_steps");
  if (key == "loop_steps") remove_key(*robot, "speed_m_s");
}

/// Makes the tables that are not there. False if drives have no such key.
bool set_drive(TomlTable& scenario, std::span<const std::string_view> key, TomlNode value) {
  const bool is_key = key.size() == 1 && holds(kDriveKeys, key[0]) && !holds(kDisturbances, key[0]);
  const bool is_part = key.size() == 2 && holds(kDisturbances, key[0]) && holds(kDisturbanceKeys, key[1]);
  if (!is_key && !is_part) return false;
  TomlTable* table = table_in(scenario, "robot");
  if (table != nullptr) table = table_in(*table, "drive");
  if (table != nullptr && is_part) table = table_in(*table, std::string(key[0]));
  if (table != nullptr) assign(*table, std::string(key.back()), std::move(value));
  return true;  // where something else stands, the reader says what is wrong there
}

/// True if the scenario has a sensor of that name, and there are sensors with such a key.
bool set_sensor(TomlTable& scenario, SensorNames sensors, std::string_view name, std::string_view key,
                TomlNode value) {
  if (!holds(names_of_sensors(scenario, sensors), name)) return false;
  const bool is_known =
      key == kMounted || (key != "name" && map::find_entity_spec("hw_sensor")->key(key) != nullptr);
  if (!is_known) return false;
  TomlTable* all = table_in(scenario, "sensor");
  TomlTable* table = all != nullptr ? table_in(*all, name) : nullptr;
  if (table != nullptr) assign(*table, key, std::move(value));  // else the reader says what is wrong there
  return true;
}

/// Clouds are the map's: a scenario need not have a table of that name.
void set_cloud(TomlTable& scenario, std::string_view name, std::string_view key, TomlNode value) {
  TomlTable* clouds = table_in(scenario, "cloud");
  TomlTable* cloud = clouds != nullptr ? table_in(*clouds, name) : nullptr;
  if (cloud != nullptr) assign(*cloud, key, std::move(value));  // else the reader says what is wrong there
}

void apply(TomlTable& scenario, SensorNames sensors, const Override& setting) {
  const std::vector<std::string_view> parts = split(setting.key, '.');
  if (parts.size() == 1 && holds(kTopOverrideKeys, parts[0])) {
    assign(scenario, parts[0], toml_value_or_text(setting.value));
    return;
  }
  if (parts.size() >= 3 && parts[0] == "robot" && parts[1] == "drive" &&
      set_drive(scenario, std::span(parts).subspan(2), toml_value_or_text(setting.value)))
    return;
  if (parts.size() == 2 && parts[0] == "robot" && parts[1] != "drive" &&
      (holds(kRobotKeys, parts[1]) || holds(kDrivenKeys, parts[1]))) {
    set_robot(scenario, std::string(parts[1]), toml_value_or_text(setting.value));
    return;
  }
  if (parts.size() == 3 && parts[0] == "sensor" &&
      set_sensor(scenario, sensors, parts[1], parts[2], toml_value_or_text(setting.value)))
    return;
  if (parts.size() == 3 && parts[0] == "cloud" && holds(kCloudKeys, parts[2])) {
    set_cloud(scenario, parts[1], parts[2], toml_value_or_text(setting.value));
    return;
  }
  // A word like a key of the scenario is that, misspelt, and no parameter of a plugin.
  const bool bare = setting.key.find('.') == std::string::npos;
  const bool misspelt = bare && (holds(kTopKeys, setting.key) || nearest_name(setting.key, kTopOverrideKeys));
  if (misspelt || !host::set_plugin_parameter(scenario, setting.key, toml_value_or_text(setting.value)))
    refuse(scenario, sensors, setting.key);
}

}  // namespace

void apply_overrides(TomlTable& scenario, std::span<const Override> overrides,
                     std::span<const std::string> sensors) {
  for (const Override& setting : overrides) {
    if (setting.key == "plugin") host::leave_plugin_alone(scenario, setting.value);
  }
  for (const Override& setting : overrides) {
    if (setting.key != "plugin") apply(scenario, sensors, setting);
  }
}

}  // namespace hallway::sim
