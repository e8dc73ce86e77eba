// SPDX-License-Identifier: MIT
#include "sim/robot_defaults.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

#include "base/toml_reader.hpp"
#include "host/plugin_table.hpp"
#include "map/entity_schema.hpp"
#include "sim/drive_keys.hpp"
#include "sim/robot_body.hpp"
#include "sim/sensors.hpp"

namespace hallway::sim {
namespace {

const TomlTable* table_of(const TomlTable& parent, std::string_view key) {
  const TomlNode* node = find(parent, key);
  return node != nullptr ? std::get_if<TomlTable>(&node->value) : nullptr;
}

/// False for a key that is for drives of another kind, which would be refused.
bool fits_kind(std::string_view key, const TomlTable& drive) {
  const TomlNode* node = find(drive, "kind");
  const auto* kind = node != nullptr ? std::get_if<std::string>(&node->value) : nullptr;
  if (kind == nullptr) return true;
  return ((key != "turn_slip" && key != "turn_slip_noise") || *kind == "tracked") &&
         (key != "max_lateral_m_s" || *kind == "omnidirectional");
}

/// Fills tables with what a robot file says.
class Defaults {
 public:
  explicit Defaults(const map::RobotFile& robot) : robot_(robot) {}

  void fill(TomlTable& root) const {
    if (TomlTable* table = table_in(root, "robot")) fill_robot(*table);
    if (!robot_.sensors.empty()) {
      if (TomlTable* table = table_in(root, "sensor")) fill_sensors(*table);
    }  // where something else stands, the reader says what is wrong there
  }

 private:
  TomlNode node(TomlNode value, int line) const {
    value.line = line;
    value.file = robot_.file;
    return value;
  }

  void give(TomlTable& table, std::string_view key, TomlNode value, int line) const {
    if (find(table, key) == nullptr) assign(table, key, node(std::move(value), line));
  }

  TomlTable* table_for(TomlTable& parent, std::string_view key, int line) const {
    give(parent, key, {.value = TomlTable{}}, line);
    return std::get_if<TomlTable>(&find(parent, key)->value);
  }

  void fill_body(TomlTable& robot) const {
    const map::RobotBody& body = robot_.body;
    const auto give_body = [&](const char* key, double value) {
      give(robot, key, {.value = value}, body.line);
    };
    const bool is_round = find(robot, "radius_m") != nullptr;
    const bool is_box = find(robot, "length_m") != nullptr || find(robot, "width_m") != nullptr;
    const auto box = box_of(body);
    if (body.is_cylinder() && !is_box) give_body("radius_m", body.radius_m);
    if (box && !is_round) {
      give_body("length_m", box->length_m);
      give_body("width_m", box->width_m);
    }
    if (!body.is_cylinder() && !box && !is_round && !is_box) return;
    give_body("bottom_m", body.bottom_m);
    give_body("top_m", body.top_m);
  }

  /// Keys such as `left_slip_mean` are of the table `left_slip`.
  void fill_drive(TomlTable& drive) const {
    const bool has_own_kind = find(drive, "kind") != nullptr;
    for (const map::RobotKey& key : robot_.drive) {
      if (has_own_kind && !fits_kind(key.key, drive)) continue;
      TomlNode value = scenario_value(map::entity_key("hw_drive", key.key), key.value);
      const auto table = std::ranges::find_if(
          kDisturbances, [&](const std::string& name) { return key.key.starts_with(name + "_"); });
      if (table == kDisturbances.end()) {
        give(drive, key.key, std::move(value), key.line);
      } else if (TomlTable* parts = table_for(drive, *table, key.line)) {
        give(*parts, key.key.substr(table->size() + 1), std::move(value), key.line);
      }
    }
  }

  void fill_robot(TomlTable& robot) const {
    fill_body(robot);
    for (const map::RobotKey& key : robot_.robot)
      give(robot, key.key, scenario_value(map::entity_key("hw_drive", key.key), key.value), key.line);
    if (!robot_.has_drive) return;
    if (TomlTable* drive = table_for(robot, "drive", robot_.drive_line)) fill_drive(*drive);
  }

  void fill_sensor(TomlTable& sensor, const map::RobotSensor& from) const {
    const auto own = std::ranges::find(from.keys, "kind", &map::RobotKey::key);
    if (own != from.keys.end()) give(sensor, "kind", {.value = own->value}, own->line);
    const map::EntitySpec& spec = *map::find_entity_spec("hw_sensor");
    const std::string kind = sensor_kind(sensor);
    for (const map::RobotKey& key : from.keys) {
      if (spec.key(key.key, kind) != nullptr)
        give(sensor, key.key, scenario_value(*spec.key(key.key, kind), key.value), key.line);
    }
  }

  void fill_sensors(TomlTable& sensors) const {
    TomlTable ordered;
    for (const map::RobotSensor& sensor : robot_.sensors) {
      const auto own = std::ranges::find(sensors, sensor.name, &TomlEntry::key);
      TomlEntry entry{sensor.name, node({.value = TomlTable{}}, sensor.line)};
      if (own != sensors.end()) {
        entry = std::move(*own);
        sensors.erase(own);
      }
      if (auto* table = std::get_if<TomlTable>(&entry.node.value)) fill_sensor(*table, sensor);
      ordered.push_back(std::move(entry));
    }
    for (TomlEntry& entry : sensors) ordered.push_back(std::move(entry));
    sensors = std::move(ordered);
  }

  const map::RobotFile& robot_;
};

}  // namespace

std::filesystem::path named_or_copy(const std::filesystem::path& scenario, const std::filesystem::path& named,
                                    const char* copy) {
  constexpr const char* kCopyOfScenario = "scenario.toml";
  std::error_code none;
  if (scenario.filename() != kCopyOfScenario || std::filesystem::exists(named, none)) return named;
  const std::filesystem::path beside = scenario.parent_path() / copy;
  return std::filesystem::exists(beside, none) ? beside : named;
}

std::optional<std::filesystem::path> find_robot_file(const TomlTable& root,
                                                     std::span<const Override> overrides,
                                                     const std::filesystem::path& scenario) {
  const TomlTable* robot = table_of(root, "robot");
  const TomlNode* node = robot != nullptr ? find(*robot, "file") : nullptr;
  TomlNode given;
  for (const Override& setting : overrides) {
    if (setting.key != "robot.file") continue;
    given = toml_value_or_text(setting.value);
    node = &given;
  }
  const auto* name = node != nullptr ? std::get_if<std::string>(&node->value) : nullptr;
  if (name == nullptr || name->empty() || name->find('\0') != std::string::npos) return std::nullopt;
  return named_or_copy(scenario, host::beside(scenario, *name, node->line), kCopyOfRobot);
}

std::vector<std::string> sensor_names(const map::RobotFile& robot) {
  std::vector<std::string> names;
  for (const map::RobotSensor& sensor : robot.sensors) names.push_back(sensor.name);
  return names;
}

void take_robot_file(TomlTable& root, const map::RobotFile& robot) {
  Defaults(robot).fill(root);
}

std::vector<SensorSpec> sensors_of(const map::RobotFile& robot) {
  TomlTable root;
  take_robot_file(root, robot);
  std::vector<SensorSpec> sensors;
  std::vector<Setting> unused;
  if (robot.sensors.empty()) return sensors;
  const std::vector<sense::BumpZone> zones = bump_zones_of(robot);
  for (const TomlEntry& entry : *table_of(root, "sensor")) {
    const auto& table = std::get<TomlTable>(entry.node.value);
    sensors.push_back(read_sensor(entry.key, {robot.file, table, entry.node.line, unused, zones}, 0).spec);
  }
  return sensors;
}

std::vector<sense::BumpZone> bump_zones_of(const map::RobotFile& robot) {
  constexpr double kSame_m = 1e-6;
  std::vector<sense::BumpZone> zones;
  for (const map::BumpZone& zone : robot.zones) {
    sense::BumpZone made{.name = zone.name, .from_rad = zone.from_rad, .to_rad = zone.to_rad};
    made.region = zone.region;
    if (zone.bottom_m > robot.body.bottom_m + kSame_m) made.bottom_m = zone.bottom_m;
    if (zone.top_m < robot.body.top_m - kSame_m) made.top_m = zone.top_m;
    zones.push_back(std::move(made));
  }
  return zones;
}

}  // namespace hallway::sim
