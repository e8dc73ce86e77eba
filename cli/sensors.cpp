// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "map/sensors.hpp"
#include "robot_settings.hpp"
#include "shared_options.hpp"
#include "sim/sensor_presets.hpp"
#include "sim/sensors.hpp"

namespace hallway::cli {
namespace {

/// The kinds that are shown: that of the name, or all.
std::vector<map::SensorKind> chosen_kinds(const std::string& name) {
  std::vector<map::SensorKind> kinds;
  std::vector<std::string> names;
  for (const map::SensorKind& kind : map::sensor_kinds()) {
    names.emplace_back(kind.name);
    if (name.empty() || kind.name == name) kinds.push_back(kind);
  }
  if (kinds.empty())
    refuse("there is no kind of sensor `{}`{}; there are {}", printable(name, 60), suggestion(name, names),
           fmt::join(names, ", "));
  return kinds;
}

std::vector<map::KeySpec> keys_of_kind(std::string_view kind) {
  std::vector<map::KeySpec> keys;
  for (const map::KeySpec& key : map::kSensorKeys) {
    if (key.name != "name" && key.name != "kind" && map::belongs(key, kind)) keys.push_back(key);
  }
  return keys;
}

/// What a key may be: "0 to 1000", "0 or 1", "lidar16, …".
std::string values_text(const map::KeySpec& key) {
  const std::string range =
      fmt::format("{}{:.10g} to {:.10g}", key.above_low ? "above " : "", key.low, key.high);
  switch (key.kind) {
    case map::KeyKind::kFlag:
      return "true or false";
    case map::KeyKind::kChoice: {
      const auto choices = split(key.choices, ' ');
      return fmt::format("{}", fmt::join(choices, ", "));
    }
    case map::KeyKind::kWhole:
      return "whole, " + range;
    case map::KeyKind::kNumbers:
      return "one or three, " + range;
    case map::KeyKind::kVector:
      return "three, " + range;
    case map::KeyKind::kList:
      return "a list, " + range;
    case map::KeyKind::kText:
      return "the name of a file";
    default:
      return range;
  }
}

std::string fallback_text(const map::KeySpec& key) {
  if (key.kind == map::KeyKind::kFlag) return key.fallback == "1" ? "true" : "false";
  return std::string(key.fallback);
}

std::string text_of_kind(const map::SensorKind& kind) {
  std::string text = fmt::format("{}: {}\n  not modelled: {}\n", kind.name, kind.about, kind.leaves_out);
  text += fmt::format("  {:<22} {:<8} {:<14} {}\n", "key", "unit", "default", "value");
  for (const map::KeySpec& key : keys_of_kind(kind.name)) {
    std::string row = fmt::format("  {:<22} {:<8} {:<14} {}", key.name, cli::unit_of(key.name),
                                  fallback_text(key), values_text(key));
    if (!key.about.empty()) row += fmt::format(": {}", key.about);
    text += row + "\n";
  }
  for (const sim::SensorPreset& preset : sim::sensor_presets()) {
    if (preset.kind != kind.name) continue;
    text += fmt::format("  preset {}:", preset.name);
    for (const auto& [key, value] : preset.values) text += fmt::format(" {} = {}", key, value);
    text += "\n";
  }
  return text;
}

Json json_of_kind(const map::SensorKind& kind) {
  Json keys = Json::array(), presets = Json::array();
  for (const map::KeySpec& key : keys_of_kind(kind.name)) {
    keys.push_back({{"key", std::string(key.name)},
                    {"unit", std::string(cli::unit_of(key.name))},
                    {"default", fallback_text(key)},
                    {"values", values_text(key)},
                    {"about", std::string(key.about)}});
  }
  for (const sim::SensorPreset& preset : sim::sensor_presets()) {
    if (preset.kind != kind.name) continue;
    Json values = Json::object();
    for (const auto& [key, value] : preset.values) values[std::string(key)] = std::string(value);
    presets.push_back({{"name", std::string(preset.name)}, {"values", values}});
  }
  return {{"name", std::string(kind.name)},
          {"about", std::string(kind.about)},
          {"not_modelled", std::string(kind.leaves_out)},
          {"keys", keys},
          {"presets", presets}};
}

struct SensorsOptions {
  std::string kind;
  bool json = false;
};

int show_sensors(const SensorsOptions& options) {
  const std::vector<map::SensorKind> kinds = chosen_kinds(options.kind);
  if (options.json) {
    Json all = Json::array();
    for (const map::SensorKind& kind : kinds) all.push_back(json_of_kind(kind));
    print_json({{"schema", "hallway.sensors/1"}, {"status", 0}, {"kinds", all}});
    return 0;
  }
  std::string text;
  for (const map::SensorKind& kind : kinds) {
    if (options.kind.empty()) {
      text += fmt::format("{:<10} {}\n", kind.name, kind.about);
    } else {
      text += text_of_kind(kind);
    }
  }
  print_result(text);
  return 0;
}

}  // namespace

void add_sensors_command(Command& app) {
  Command& command = app.command(
      "sensors",
      "List the kinds of sensors, or the keys of one with units, defaults and what it does not model");
  SensorsOptions& options = command.runs(&show_sensors);
  command.argument("kind", &options.kind,
                   "A kind, as a scenario's [sensor.NAME] names it; none: all of them");
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "Example: hallway sensors\n"
      "Example: hallway sensors lidar");
}

}  // namespace hallway::cli
