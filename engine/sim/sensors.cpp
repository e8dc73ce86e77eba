// SPDX-License-Identifier: MIT
#include "sim/sensors.hpp"

#include <numbers>
#include <string_view>
#include <utility>

#include "base/text.hpp"
#include "map/sensors.hpp"
#include "sim/schema.hpp"

namespace hallway::sim {
namespace {

Range range_of(const char* key) {
  const map::KeySpec& spec = map::sensor_key(key);
  return {spec.low, spec.high, spec.above_low};
}

double number(TableReader& sensor, const char* key) {
  return sensor.number(key, range_of(key), parse_double(map::sensor_key(key).fallback));
}

double angle(TableReader& sensor, const char* key) {
  return number(sensor, key) * (std::numbers::pi / 180.0);
}

/// A key's value as a scenario would have it: a list where it is several numbers.
TomlNode node_of(const map::KeyValue& pair) {
  TomlArray numbers;
  for (const std::string_view part : split(pair.value, ' ')) {
    if (const auto value = parse_double(trim(part))) numbers.push_back({.value = *value, .line = pair.line});
  }
  if (numbers.empty()) return {.value = pair.value, .line = pair.line};
  if (numbers.size() == 1) return std::move(numbers.front());
  return {.value = std::move(numbers), .line = pair.line};
}

/// The table that a scenario would have for a sensor of a map.
TomlTable table_of(const map::Entity& entity) {
  TomlTable table;
  for (const std::string& key : kSensorKeys) {
    for (const map::KeyValue& pair : entity.keys) {
      if (pair.key == key) table.push_back({key, node_of(pair)});
    }
  }
  return table;
}

}  // namespace

sense::PointSensorSpec read_sensor(const std::string& name, TableReader& sensor,
                                   const std::optional<std::size_t>& kind) {
  sense::PointSensorSpec spec;
  spec.name = name;
  sensor.choice("kind", {"points"}, kind);
  spec.horizontal_fov = angle(sensor, "horizontal_fov_deg");
  spec.vertical_fov = angle(sensor, "vertical_fov_deg");
  spec.min_range_m = number(sensor, "min_range_m");
  spec.max_range_m = number(sensor, "max_range_m");
  if (spec.min_range_m > spec.max_range_m) {
    throw sensor.error(sensor.has("min_range_m") ? "min_range_m" : "max_range_m",
                       "min_range_m = " + format_double(spec.min_range_m) +
                           " is above max_range_m = " + format_double(spec.max_range_m));
  }
  spec.noise_m = sensor.vector_or_one("noise_m", range_of("noise_m"), Vec3::Zero());
  spec.noise_per_m = sensor.vector_or_one("noise_per_m", range_of("noise_per_m"), Vec3::Zero());
  spec.T_body_sensor.t = sensor.vector("position_m", range_of("position_m"), Vec3::Zero());
  const double yaw = angle(sensor, "yaw_deg");
  const double pitch = angle(sensor, "pitch_deg");
  const double roll = angle(sensor, "roll_deg");
  spec.T_body_sensor.q = from_yaw_pitch_roll(yaw, pitch, roll);
  return spec;
}

void take_map_sensors(Scenario& scenario, const map::Document& document) {
  if (!scenario.sensors.empty()) return;
  for (const map::Entity* entity : map::sensors(document)) {
    const std::string name = map::EntityKeys(document, *entity).text("name");
    const TomlTable table = table_of(*entity);
    TableReader sensor(document.file, "sensor." + name, table, entity->line, kSensorKeys, scenario.settings);
    scenario.sensors.push_back(read_sensor(name, sensor, 0));
  }
}

}  // namespace hallway::sim
