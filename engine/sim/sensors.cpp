// SPDX-License-Identifier: MIT
#include "sim/sensors.hpp"

#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>
#include <variant>

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

Quat orientation(TableReader& sensor) {
  const double yaw = angle(sensor, "yaw_deg");
  const double pitch = angle(sensor, "pitch_deg");
  return from_yaw_pitch_roll(yaw, pitch, angle(sensor, "roll_deg"));
}

bool flag(TableReader& sensor, const char* key) {
  return sensor.flag(key, map::sensor_key(key).fallback == "1");
}

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
  for (const map::KeySpec& key : map::find_entity_spec(entity.classname())->keys) {
    if (key.name == "name") continue;
    for (const map::KeyValue& pair : entity.keys) {
      if (pair.key != key.name) continue;
      table.push_back({pair.key, scenario_value(key, pair.value)});
      table.back().node.line = pair.line;
    }
  }
  return table;
}

const std::vector<std::string> kKinds{"points", "planes", "faces", "bump", "encoders"};
constexpr std::size_t kPlanes = 1;
constexpr std::size_t kFaces = 2;
constexpr std::size_t kBump = 3;
constexpr std::size_t kEncoders = 4;

/// With those of all kinds.
std::vector<std::string> known_keys(const TomlTable& table) {
  std::vector<std::string> keys = sensor_keys(table);
  keys.emplace_back(kMounted);
  return keys;
}

void check_ranges(const TableReader& sensor, double min_range_m, double max_range_m) {
  if (min_range_m <= max_range_m) return;
  throw sensor.error(sensor.has("min_range_m") ? "min_range_m" : "max_range_m",
                     "min_range_m = " + format_double(min_range_m) +
                         " is above max_range_m = " + format_double(max_range_m));
}

/// What a table does not say is not noted as one of its settings.
sense::SensorTiming timing(TableReader& sensor) {
  const auto told = [&](const char* key) { return sensor.has(key) ? number(sensor, key) : 0.0; };
  return {.rate_hz = told("rate_hz"), .phase_s = told("phase_s"), .latency_s = told("latency_s")};
}

sense::PointSensorSpec read_points(const std::string& name, TableReader& sensor) {
  sense::PointSensorSpec spec;
  spec.name = name;
  spec.horizontal_fov = angle(sensor, "horizontal_fov_deg");
  spec.vertical_fov = angle(sensor, "vertical_fov_deg");
  spec.min_range_m = number(sensor, "min_range_m");
  spec.max_range_m = number(sensor, "max_range_m");
  check_ranges(sensor, spec.min_range_m, spec.max_range_m);
  spec.noise_m = sensor.vector_or_one("noise_m", range_of("noise_m"), Vec3::Zero());
  spec.noise_per_m = sensor.vector_or_one("noise_per_m", range_of("noise_per_m"), Vec3::Zero());
  spec.T_body_sensor.t = sensor.vector("position_m", range_of("position_m"), Vec3::Zero());
  spec.T_body_sensor.q = orientation(sensor);
  spec.timing = timing(sensor);
  return spec;
}

/// What sensors of walls and of faces share.
sense::PlaneSensorSpec read_view(const std::string& name, TableReader& sensor) {
  sense::PlaneSensorSpec spec;
  spec.name = name;
  spec.view.horizontal_fov = angle(sensor, "horizontal_fov_deg");
  spec.vertical_fov = angle(sensor, "vertical_fov_deg");
  spec.view.min_range_m = number(sensor, "min_range_m");
  spec.view.max_range_m = number(sensor, "max_range_m");
  check_ranges(sensor, spec.view.min_range_m, spec.view.max_range_m);
  spec.view.occlusion = flag(sensor, "occlusion");
  spec.view.min_length_m = number(sensor, "min_length_m");
  spec.noise_m = number(sensor, "noise_m");
  spec.noise_angle = angle(sensor, "noise_angle_deg");
  spec.noise_end_m = number(sensor, "noise_end_m");
  spec.timing = timing(sensor);
  spec.T_body_sensor.t = sensor.vector("position_m", range_of("position_m"), Vec3::Zero());
  return spec;
}

sense::PlaneSensorSpec read_planes(const std::string& name, TableReader& sensor) {
  sense::PlaneSensorSpec spec = read_view(name, sensor);
  spec.view.bounded_sides = flag(sensor, "bounded_sides");
  spec.T_body_sensor.q = from_yaw_pitch_roll(angle(sensor, "yaw_deg"), 0.0, 0.0);
  return spec;
}

sense::PlaneSensorSpec read_faces(const std::string& name, TableReader& sensor) {
  sense::PlaneSensorSpec spec = read_view(name, sensor);
  spec.shape = sense::PlaneShape::faces;
  for (const char* key : {"horizontal_fov_deg", "vertical_fov_deg"}) {
    if (number(sensor, key) >= 180.0)
      throw sensor.error(key, std::string(key) + " = " + format_double(number(sensor, key)) +
                                  ": a sensor of faces sees less than 180 degrees");
  }
  spec.T_body_sensor.q = orientation(sensor);
  return spec;
}

/// Equal sectors, counter-clockwise from straight ahead.
std::vector<sense::BumpZone> equal_zones(std::int64_t n) {
  std::vector<sense::BumpZone> zones;
  const double each = 2.0 * std::numbers::pi / static_cast<double>(n);
  for (std::int64_t i = 0; i < n; ++i)
    zones.push_back({.name = "zone_" + std::to_string(i + 1),
                     .from_rad = each * static_cast<double>(i),
                     .to_rad = each * static_cast<double>(i + 1)});
  return zones;
}

sense::BumpSensorSpec read_bump(const std::string& name, TableReader& sensor,
                                std::span<const sense::BumpZone> zones) {
  sense::BumpSensorSpec spec;
  spec.name = name;
  if (!zones.empty()) spec.zones.assign(zones.begin(), zones.end());
  if (sensor.has("zones")) {
    const Range most = range_of("zones");
    spec.zones = equal_zones(sensor.whole("zones", std::llround(most.low), std::llround(most.high)));
  }
  if (sensor.has("depth")) spec.depth = sensor.flag("depth");
  if (sensor.has("skin_m")) spec.skin_m = number(sensor, "skin_m");
  if (sensor.has("missed_rate")) spec.missed_rate = number(sensor, "missed_rate");
  if (sensor.has("false_rate")) spec.false_rate = number(sensor, "false_rate");
  spec.timing = timing(sensor);
  return spec;
}

/// The wheels' radius is the drive's.
sense::EncoderSensorSpec read_encoders(const std::string& name, TableReader& sensor) {
  sense::EncoderSensorSpec spec;
  spec.name = name;
  if (sensor.has("ticks_per_revolution")) spec.ticks_per_revolution = number(sensor, "ticks_per_revolution");
  if (sensor.has("radius_error_sigma")) spec.radius_error_sigma = number(sensor, "radius_error_sigma");
  spec.timing = timing(sensor);
  return spec;
}

}  // namespace

std::vector<std::string> sensor_keys(const TomlTable& table) {
  const TomlNode* kind = find(table, "kind");
  const auto* name = kind != nullptr ? std::get_if<std::string>(&kind->value) : nullptr;
  if (name == nullptr || *name == kKinds[0]) return kPointSensorKeys;
  if (*name == kKinds[kPlanes]) return kPlaneSensorKeys;
  if (*name == kKinds[kFaces]) return kFaceSensorKeys;
  if (*name == kKinds[kBump]) return kBumpSensorKeys;
  if (*name == kKinds[kEncoders]) return kEncoderSensorKeys;
  std::vector<std::string> all = kPointSensorKeys;
  all.insert(all.end(), kPlaneSensorKeys.begin(), kPlaneSensorKeys.end());
  return all;
}

TomlNode scenario_value(const map::KeySpec& key, const std::string& value) {
  if (key.kind == map::KeyKind::kWhole) {
    if (const auto whole = parse_int(trim(value))) return {.value = *whole};
  }
  if (key.kind == map::KeyKind::kFlag && (value == "0" || value == "1")) return {.value = value == "1"};
  if (key.kind == map::KeyKind::kChoice) return {.value = value};
  return node_of(value);
}

bool is_mounted(const std::string& name, const SensorTable& where) {
  TableReader sensor(where.file, "sensor." + name, where.table, where.line, known_keys(where.table),
                     where.settings);
  return !sensor.has(kMounted) || sensor.flag(kMounted);
}

SensorSpec read_sensor(const std::string& name, const SensorTable& where,
                       const std::optional<std::size_t>& kind) {
  TableReader sensor(where.file, "sensor." + name, where.table, where.line, known_keys(where.table),
                     where.settings);
  switch (sensor.choice("kind", kKinds, kind)) {
    case kPlanes:
      return read_planes(name, sensor);
    case kFaces:
      return read_faces(name, sensor);
    case kBump:
      return read_bump(name, sensor, where.zones);
    case kEncoders:
      return read_encoders(name, sensor);
    default:
      return read_points(name, sensor);
  }
}

void take_map_sensors(Scenario& scenario, const map::Document& document) {
  if (!scenario.takes_map_sensors) return;
  for (const map::Entity* entity : map::sensors(document)) {
    const std::string name = map::EntityKeys(document, *entity).text("name");
    const TomlTable table = table_of(*entity);
    scenario.sensors.push_back(
        read_sensor(name, {document.file, table, entity->line, scenario.settings, scenario.bump_zones}, 0));
  }
}

}  // namespace hallway::sim
