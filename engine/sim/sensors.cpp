// SPDX-License-Identifier: MIT
#include "sim/sensors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string_view>
#include <utility>
#include <variant>

#include "base/text.hpp"
#include "map/sensors.hpp"
#include "sim/schema.hpp"
#include "sim/sensor_kinds.hpp"
#include "sim/sensor_presets.hpp"

namespace hallway::sim {
namespace {

/// A list where it is several numbers.
TomlNode node_of(const std::string& value) {
  TomlArray numbers;
  for (const std::string_view part : split(value, ' ')) {
    if (const auto number = parse_double(trim(part))) numbers.push_back({.value = *number});
  }
  if (numbers.empty()) return {.value = value};
  if (numbers.size() == 1) return std::move(numbers.front());
  return {.value = std::move(numbers)};
}

/// The table that a scenario would have for a sensor of a map.
TomlTable table_of(const map::Entity& entity) {
  TomlTable table;
  const map::EntitySpec& spec = *map::find_entity_spec(entity.classname());
  for (const map::KeySpec& key : spec.keys) {
    if (key.name == "name" || !map::belongs(key, map::variant_of(spec, entity))) continue;
    for (const map::KeyValue& pair : entity.keys) {
      if (pair.key != key.name) continue;
      table.push_back({pair.key, scenario_value(key, pair.value)});
      table.back().node.line = pair.line;
    }
  }
  return table;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const map::SensorKind& kind : map::sensor_kinds()) names.emplace_back(kind.name);
  return names;
}

/// With that of scenarios alone. Of a kind that is none those of points and planes.
std::vector<std::string> known_keys(const TomlTable& table) {
  const std::string kind = sensor_kind(table);
  const std::vector<std::string> kinds = kind_names();
  const bool is_kind = std::ranges::find(kinds, kind) != kinds.end();
  std::vector<std::string> keys = map::sensor_key_names(is_kind ? kind : "points");
  if (!is_kind) {
    for (std::string& key : map::sensor_key_names("planes")) keys.push_back(std::move(key));
  }
  keys.emplace_back(kMounted);
  return keys;
}

sense::PointSensorSpec read_points(const std::string& name, SensorReader& sensor) {
  sense::PointSensorSpec spec;
  spec.name = name;
  spec.horizontal_fov = sensor.angle("horizontal_fov_deg");
  spec.vertical_fov = sensor.angle("vertical_fov_deg");
  spec.min_range_m = sensor.number("min_range_m");
  spec.max_range_m = sensor.number("max_range_m");
  sensor.check_ranges(spec.min_range_m, spec.max_range_m);
  spec.noise_m = sensor.one_or_three("noise_m");
  spec.noise_per_m = sensor.one_or_three("noise_per_m");
  spec.detection = sensor.detection();
  sensor.place(spec);
  return spec;
}

/// What sensors of walls and of faces share.
sense::PlaneSensorSpec read_view(const std::string& name, SensorReader& sensor) {
  sense::PlaneSensorSpec spec;
  spec.name = name;
  spec.view.horizontal_fov = sensor.angle("horizontal_fov_deg");
  spec.vertical_fov = sensor.angle("vertical_fov_deg");
  spec.view.min_range_m = sensor.number("min_range_m");
  spec.view.max_range_m = sensor.number("max_range_m");
  sensor.check_ranges(spec.view.min_range_m, spec.view.max_range_m);
  spec.view.occlusion = sensor.flag("occlusion");
  spec.view.min_length_m = sensor.number("min_length_m");
  spec.noise_m = sensor.number("noise_m");
  spec.noise_angle = sensor.angle("noise_angle_deg");
  spec.noise_end_m = sensor.number("noise_end_m");
  spec.detection = sensor.detection();
  sensor.place(spec);
  return spec;
}

sense::PlaneSensorSpec read_planes(const std::string& name, SensorReader& sensor) {
  sense::PlaneSensorSpec spec = read_view(name, sensor);
  spec.view.bounded_sides = sensor.flag("bounded_sides");
  return spec;
}

sense::PlaneSensorSpec read_faces(const std::string& name, SensorReader& sensor) {
  sense::PlaneSensorSpec spec = read_view(name, sensor);
  spec.shape = sense::PlaneShape::faces;
  for (const char* key : {"horizontal_fov_deg", "vertical_fov_deg"}) {
    if (sensor.number(key) >= 180.0)
      throw sensor.error(key, std::string(key) + " = " + format_double(sensor.number(key)) +
                                  ": a sensor of faces sees less than 180 degrees");
  }
  return spec;
}

/// Equal sectors, counter-clockwise from straight ahead.
std::vector<sense::BumpZone> equal_zones(std::uint32_t n) {
  std::vector<sense::BumpZone> zones;
  const double each = 2.0 * std::numbers::pi / n;
  for (std::uint32_t i = 0; i < n; ++i)
    zones.push_back({.name = "zone_" + std::to_string(i + 1),
                     .from_rad = each * static_cast<double>(i),
                     .to_rad = each * static_cast<double>(i + 1)});
  return zones;
}

sense::BumpSensorSpec read_bump(const std::string& name, SensorReader& sensor,
                                std::span<const sense::BumpZone> zones) {
  sense::BumpSensorSpec spec;
  spec.name = name;
  if (!zones.empty()) spec.zones.assign(zones.begin(), zones.end());
  if (sensor.has("zones")) spec.zones = equal_zones(sensor.whole("zones"));
  if (sensor.has("depth")) spec.depth = sensor.flag("depth");
  if (sensor.has("skin_m")) spec.skin_m = sensor.number("skin_m");
  if (sensor.has("missed_rate")) spec.missed_rate = sensor.number("missed_rate");
  if (sensor.has("false_rate")) spec.false_rate = sensor.number("false_rate");
  spec.timing = sensor.timing();
  return spec;
}

SensorSpec read_kind(const std::string& name, std::string_view kind, SensorReader& sensor,
                     std::span<const sense::BumpZone> zones) {
  if (kind == "planes") return read_planes(name, sensor);
  if (kind == "faces") return read_faces(name, sensor);
  if (kind == "bump") return read_bump(name, sensor, zones);
  if (kind == "encoders") return read_encoders(name, sensor);
  if (kind == "odometry") return read_odometry(name, sensor);
  if (kind == "mouse") return read_mouse(name, sensor);
  if (kind == "gyro") return read_inertial(name, sensor, true);
  if (std::ranges::find(sensor_presets(), kind, &SensorPreset::kind) == sensor_presets().end())
    return read_points(name, sensor);
  sensor.choice("preset");
  if (kind == "sonar") return read_sonar(name, sensor);
  if (kind == "infrared") return read_infrared(name, sensor);
  if (kind == "gnss") return read_gnss(name, sensor);
  if (kind == "compass") return read_compass(name, sensor);
  if (kind == "imu") return read_inertial(name, sensor, false);
  return read_lidar(name, sensor);
}

}  // namespace

std::string sensor_kind(const TomlTable& table) {
  const TomlNode* kind = find(table, "kind");
  const auto* name = kind != nullptr ? std::get_if<std::string>(&kind->value) : nullptr;
  return name != nullptr ? *name : "points";
}

TomlNode scenario_value(const map::KeySpec& key, const std::string& value) {
  if (key.kind == map::KeyKind::kWhole) {
    if (const auto whole = parse_int(trim(value))) return {.value = *whole};
  }
  if (key.kind == map::KeyKind::kFlag && (value == "0" || value == "1")) return {.value = value == "1"};
  if (key.kind == map::KeyKind::kChoice || key.kind == map::KeyKind::kText) return {.value = value};
  return node_of(value);
}

bool is_mounted(const std::string& name, const SensorTable& where) {
  TableReader sensor(where.file, "sensor." + name, where.table, where.line, known_keys(where.table),
                     where.settings);
  return !sensor.has(kMounted) || sensor.flag(kMounted);
}

MountedSpec read_sensor(const std::string& name, const SensorTable& where,
                        const std::optional<std::size_t>& kind) {
  const TomlTable filled = with_preset(where.table);
  TableReader table(where.file, "sensor." + name, filled, where.line, known_keys(where.table),
                    where.settings);
  const std::string_view chosen = map::sensor_kinds()[table.choice("kind", kind_names(), kind)].name;
  SensorReader sensor(table, chosen);
  MountedSpec mounted{.spec = read_kind(name, chosen, sensor, where.zones)};
  if (map::find_entity_spec("hw_sensor")->key("mount_error_m", chosen) != nullptr)
    mounted.mount_error = sensor.mount_error();
  return mounted;
}

void add_sensor(Scenario& scenario, const std::string& name, MountedSpec sensor) {
  if (sensor.mount_error) scenario.mount_errors.emplace(name, *sensor.mount_error);
  scenario.sensors.push_back(std::move(sensor.spec));
}

void take_map_sensors(Scenario& scenario, const map::Document& document) {
  if (!scenario.takes_map_sensors) return;
  for (const map::Entity* entity : map::sensors(document)) {
    const std::string name = map::EntityKeys(document, *entity).text("name");
    const TomlTable table = table_of(*entity);
    add_sensor(
        scenario, name,
        read_sensor(name, {document.file, table, entity->line, scenario.settings, scenario.bump_zones}, 0));
  }
}

}  // namespace hallway::sim
