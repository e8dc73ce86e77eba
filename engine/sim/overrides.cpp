// SPDX-License-Identifier: MIT
#include "sim/overrides.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "base/toml_reader.hpp"
#include "sim/scenario.hpp"
#include "sim/schema.hpp"

namespace hallway::sim {
namespace {

bool holds(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

TomlNode value_of(const Override& setting) {
  if (auto value = parse_toml_value(setting.value)) return std::move(*value);
  return {.value = setting.value, .line = 0};
}

void assign(TomlTable& table, std::string_view key, TomlNode value) {
  if (TomlNode* node = find(table, key)) {
    *node = std::move(value);
  } else {
    table.push_back({std::string(key), std::move(value)});
  }
}

void remove_key(TomlTable& table, std::string_view key) {
  std::erase_if(table, [&](const TomlEntry& entry) { return entry.key == key; });
}

/// The table `key`, made where it is missing; null where something else stands there.
TomlTable* table_in(TomlTable& parent, std::string_view key) {
  if (find(parent, key) == nullptr) parent.push_back({std::string(key), {.value = TomlTable{}, .line = 0}});
  return std::get_if<TomlTable>(&find(parent, key)->value);
}

/// The [[plugin]] tables that have a name.
std::vector<std::pair<std::string, TomlTable*>> named_plugins(TomlTable& scenario) {
  std::vector<std::pair<std::string, TomlTable*>> plugins;
  TomlNode* list = find(scenario, "plugin");
  auto* items = list != nullptr ? std::get_if<TomlArray>(&list->value) : nullptr;
  if (items == nullptr) return plugins;
  for (TomlNode& item : *items) {
    auto* table = std::get_if<TomlTable>(&item.value);
    const TomlNode* name = table != nullptr ? find(*table, "name") : nullptr;
    const auto* text = name != nullptr ? std::get_if<std::string>(&name->value) : nullptr;
    if (text != nullptr) plugins.emplace_back(short_plugin_name(*text), table);
  }
  return plugins;
}

/// The names of the [sensor.NAME] tables.
std::vector<std::string> sensor_names(const TomlTable& scenario) {
  std::vector<std::string> names;
  const TomlNode* node = find(scenario, "sensor");
  const auto* sensors = node != nullptr ? std::get_if<TomlTable>(&node->value) : nullptr;
  if (sensors == nullptr) return names;
  for (const TomlEntry& sensor : *sensors) {
    if (std::holds_alternative<TomlTable>(sensor.node.value)) names.push_back(sensor.key);
  }
  return names;
}

/// Every key that could have been meant, for suggestions.
std::vector<std::string> settable_keys(TomlTable& scenario) {
  std::vector<std::string> keys = kTopOverrideKeys;
  keys.push_back("plugin");
  for (const std::string& key : kRobotKeys) keys.push_back("robot." + key);
  for (const std::string& name : sensor_names(scenario)) {
    for (const std::string& key : kSensorKeys) keys.push_back("sensor." + name + "." + key);
  }
  for (const auto& [name, table] : named_plugins(scenario)) {
    const TomlNode* params = find(*table, "params");
    const auto* entries = params != nullptr ? std::get_if<TomlTable>(&params->value) : nullptr;
    if (entries == nullptr) continue;
    for (const TomlEntry& entry : *entries) keys.push_back(name + "." + entry.key);
  }
  return keys;
}

[[noreturn]] void refuse(TomlTable& scenario, const std::string& key) {
  throw Error(ErrorCode::kUsage,
              "the scenario has no such setting" + suggestion(key, settable_keys(scenario)),
              {.file = "command line", .element = "key `" + printable(key) + "`"});
}

void leave_plugin_alone(TomlTable& scenario, const std::string& plugin) {
  TomlTable table;
  for (auto& [name, candidate] : named_plugins(scenario)) {
    if (name == short_plugin_name(plugin)) table = *candidate;
  }
  assign(table, "name", {.value = plugin, .line = 0});
  TomlArray pipeline;
  pipeline.push_back({.value = std::move(table), .line = 0});
  assign(scenario, "plugin", {.value = std::move(pipeline), .line = 0});
}

void set_robot(TomlTable& scenario, const std::string& key, TomlNode value) {
  TomlTable* robot = table_in(scenario, "robot");
  if (robot == nullptr) return;  // the reader says what is wrong there
  assign(*robot, key, std::move(value));
  if (key == "speed_m_s") remove_key(*robot, "loop_steps");
  if (key == "loop_steps") remove_key(*robot, "speed_m_s");
}

/// True if the scenario has a sensor of that name with such a key.
bool set_sensor(TomlTable& scenario, std::string_view name, std::string_view key, TomlNode value) {
  if (!holds(sensor_names(scenario), name) || !holds(kSensorKeys, key)) return false;
  assign(*table_in(*table_in(scenario, "sensor"), name), key, std::move(value));
  return true;
}

/// True if the scenario has a plugin of that name.
bool set_plugin_parameter(TomlTable& scenario, std::string_view plugin, std::string_view key,
                          const TomlNode& value) {
  for (auto& [name, table] : named_plugins(scenario)) {
    if (name != plugin || key.empty()) continue;
    if (TomlTable* params = table_in(*table, "params")) assign(*params, key, value);
    return true;
  }
  return false;
}

void apply(TomlTable& scenario, const Override& setting) {
  const std::vector<std::string_view> parts = split(setting.key, '.');
  if (parts.size() == 1 && holds(kTopOverrideKeys, parts[0])) {
    assign(scenario, parts[0], value_of(setting));
    return;
  }
  if (parts.size() == 2 && parts[0] == "robot" && holds(kRobotKeys, parts[1])) {
    set_robot(scenario, std::string(parts[1]), value_of(setting));
    return;
  }
  if (parts.size() == 3 && parts[0] == "sensor" &&
      set_sensor(scenario, parts[1], parts[2], value_of(setting)))
    return;
  const std::size_t dot = setting.key.rfind('.');
  if (dot == std::string::npos) refuse(scenario, setting.key);
  const std::string_view key = setting.key;
  if (!set_plugin_parameter(scenario, key.substr(0, dot), key.substr(dot + 1), value_of(setting))) {
    refuse(scenario, setting.key);
  }
}

}  // namespace

void apply_overrides(TomlTable& scenario, std::span<const Override> overrides) {
  for (const Override& setting : overrides) {
    if (setting.key == "plugin") leave_plugin_alone(scenario, setting.value);
  }
  for (const Override& setting : overrides) {
    if (setting.key != "plugin") apply(scenario, setting);
  }
}

}  // namespace hallway::sim
