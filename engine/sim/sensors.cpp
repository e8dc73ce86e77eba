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
#include "host/plugin_table.hpp"
#include "map/sensors.hpp"
#include "sim/pattern_file.hpp"
#include "sim/schema.hpp"

namespace hallway::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Reads keys of a sensor of one kind, whose ranges and defaults are those of a map's.
class SensorReader {
 public:
  SensorReader(TableReader& table, std::string_view kind) : table_(table), kind_(kind) {}

  bool has(const char* key) const { return table_.has(key); }
  double number(const char* key) { return table_.number(key, range(key), parse_double(spec(key).fallback)); }
  double angle(const char* key) { return number(key) * kDegree; }
  bool flag(const char* key) { return table_.flag(key, spec(key).fallback == "1"); }
  std::uint32_t whole(const char* key) {
    const map::KeySpec& known = spec(key);
    return static_cast<std::uint32_t>(table_.whole(key, std::llround(known.low), std::llround(known.high),
                                                   parse_int(std::string(known.fallback))));
  }
  Vec3 one_or_three(const char* key) { return table_.vector_or_one(key, range(key), Vec3::Zero()); }
  Vec3 position() { return table_.vector("position_m", range("position_m"), Vec3::Zero()); }
  Quat orientation() {
    const double yaw = angle("yaw_deg");
    const double pitch = angle("pitch_deg");
    return from_yaw_pitch_roll(yaw, pitch, angle("roll_deg"));
  }
  /// A file that a key names, beside the one that the key is in.
  std::filesystem::path file(const char* key) {
    return host::beside(table_.file(key), table_.text(key), table_.line(key));
  }
  Error error(const char* key, const std::string& problem) const { return table_.error(key, problem); }

  /// What a table does not say is not noted as one of its settings.
  double number_if_told(const char* key) { return has(key) ? number(key) : 0.0; }
  sense::SensorTiming timing() {
    return {.rate_hz = number_if_told("rate_hz"),
            .phase_s = number_if_told("phase_s"),
            .latency_s = number_if_told("latency_s"),
            .clock = {.offset_s = number_if_told("clock_offset_s"),
                      .drift_ppm = number_if_told("clock_drift_ppm"),
                      .jitter_s = number_if_told("clock_jitter_s")}};
  }
  sense::DetectionSpec detection() {
    return {.dropout = number_if_told("dropout"), .clutter = number_if_told("clutter")};
  }
  /// The true mount in the frame of the one that is told; none where they are the same.
  std::optional<Pose> mount_error() {
    if (!has("mount_error_m") && !has("mount_error_deg")) return std::nullopt;
    Pose error;
    error.t = table_.vector("mount_error_m", range("mount_error_m"), Vec3::Zero());
    const Vec3 turn = table_.vector("mount_error_deg", range("mount_error_deg"), Vec3::Zero()) * kDegree;
    error.q = from_yaw_pitch_roll(turn.x(), turn.y(), turn.z());
    return error;
  }
  std::size_t choice(const char* key) {
    const auto choices = split(spec(key).choices, ' ');
    const auto fallback = std::ranges::find(choices, spec(key).fallback) - choices.begin();
    return table_.choice(key, {choices.begin(), choices.end()}, static_cast<std::size_t>(fallback));
  }
  void check_ranges(double min_range_m, double max_range_m) const {
    if (min_range_m <= max_range_m) return;
    throw error(has("min_range_m") ? "min_range_m" : "max_range_m",
                "min_range_m = " + format_double(min_range_m) +
                    " is above max_range_m = " + format_double(max_range_m));
  }

 private:
  const map::KeySpec& spec(const char* key) const { return map::sensor_key(kind_, key); }
  Range range(const char* key) const { return {spec(key).low, spec(key).high, spec(key).above_low}; }

  TableReader& table_;
  std::string_view kind_;
};

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
  spec.T_body_sensor.t = sensor.position();
  spec.T_body_sensor.q = sensor.orientation();
  spec.timing = sensor.timing();
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
  spec.timing = sensor.timing();
  spec.T_body_sensor.t = sensor.position();
  return spec;
}

sense::PlaneSensorSpec read_planes(const std::string& name, SensorReader& sensor) {
  sense::PlaneSensorSpec spec = read_view(name, sensor);
  spec.view.bounded_sides = sensor.flag("bounded_sides");
  spec.T_body_sensor.q = from_yaw_pitch_roll(sensor.angle("yaw_deg"), 0.0, 0.0);
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
  spec.T_body_sensor.q = sensor.orientation();
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

/// The wheels are the drive's where there is one.
EncoderSpec read_encoders(const std::string& name, SensorReader& sensor) {
  EncoderSpec spec;
  if (sensor.has("wheel_base_m")) spec.wheel_base_m = sensor.number("wheel_base_m");
  if (sensor.has("wheel_radius_m")) spec.wheel_radius_m = sensor.number("wheel_radius_m");
  spec.name = name;
  if (sensor.has("ticks_per_revolution")) spec.ticks_per_revolution = sensor.number("ticks_per_revolution");
  if (sensor.has("radius_error_sigma")) spec.radius_error_sigma = sensor.number("radius_error_sigma");
  spec.timing = sensor.timing();
  return spec;
}

sense::OffPlane read_off_plane(SensorReader& sensor) {
  return {.height_m = sensor.number("off_plane_m"), .tilt_rad = sensor.angle("off_plane_deg")};
}

/// Likewise.
sense::WheelOdometrySpec read_odometry(const std::string& name, SensorReader& sensor) {
  sense::WheelOdometrySpec spec;
  spec.name = name;
  spec.encoder.name = name;
  spec.encoder.wheel_radius_m = sensor.number("wheel_radius_m");
  spec.encoder.ticks_per_revolution = sensor.number("ticks_per_revolution");
  spec.encoder.radius_error_sigma = spec.radius_sigma = sensor.number("radius_error_sigma");
  spec.wheels = sense::two_odometry_wheels(sensor.number("wheel_base_m"));
  spec.slip = sensor.number("slip");
  spec.side_slip = sensor.number("side_slip");
  spec.off_plane = read_off_plane(sensor);
  spec.timing = sensor.timing();
  return spec;
}

sense::MouseOdometrySpec read_mouse(const std::string& name, SensorReader& sensor) {
  sense::MouseOdometrySpec spec;
  spec.name = name;
  spec.counts_per_m = sensor.number("counts_per_m");
  spec.scale_sigma = sensor.number("scale_sigma");
  spec.noise = sensor.number("noise_per_root_m");
  if (const double apart_m = sensor.number("apart_m"); apart_m > 0.0)
    spec.places = {{.position_m = {0.0, 0.5 * apart_m}}, {.position_m = {0.0, -0.5 * apart_m}}};
  spec.off_plane = read_off_plane(sensor);
  spec.T_body_sensor.t = sensor.position();
  spec.T_body_sensor.q = from_yaw_pitch_roll(sensor.angle("yaw_deg"), 0.0, 0.0);
  spec.timing = sensor.timing();
  return spec;
}

/// Of an IMU, or of a gyro, which has no accelerometers.
sense::ImuSensorSpec read_inertial(const std::string& name, SensorReader& sensor, bool is_gyro) {
  sense::ImuSensorSpec spec;
  spec.name = name;
  spec.gyro.noise = sensor.number("gyro_noise");
  spec.gyro.walk = sensor.number("gyro_walk");
  spec.gyro.bias_sigma = sensor.number("gyro_bias_sigma");
  spec.gyro.scale_sigma = sensor.number("gyro_scale_sigma");
  spec.gyro.limit = sensor.number("gyro_limit");
  spec.gyro.misalignment_rad = sensor.angle("misalignment_deg");
  if (is_gyro) {
    spec.accelerometer.axes = {false, false, false};
    if (sensor.choice("axes") == 1) spec.gyro.axes = {false, false, true};
  } else {
    spec.accelerometer.noise = sensor.number("force_noise");
    spec.accelerometer.walk = sensor.number("force_walk");
    spec.accelerometer.bias_sigma = sensor.number("force_bias_sigma");
    spec.accelerometer.scale_sigma = sensor.number("force_scale_sigma");
    spec.accelerometer.limit = sensor.number("force_limit");
    spec.accelerometer.misalignment_rad = spec.gyro.misalignment_rad;
    spec.gravity_m_s2 = sensor.number("gravity_m_s2");
  }
  spec.T_body_sensor.t = sensor.position();
  spec.T_body_sensor.q = sensor.orientation();
  spec.timing = sensor.timing();
  return spec;
}

constexpr std::array kSpinKeys{"rings",    "lowest_deg", "highest_deg", "columns",
                               "from_deg", "step_deg",   "clockwise"};

/// That of a file beside the one that names it.
sense::RayPattern read_named_pattern(SensorReader& sensor) {
  for (const char* key : kSpinKeys) {
    if (sensor.has(key)) throw sensor.error(key, "is given together with `pattern`, which has all beams");
  }
  const double rate_hz = sensor.number_if_told("rate_hz");
  if (rate_hz == 0.0) throw sensor.error("pattern", "needs `rate_hz`: a scan takes the time to the next one");
  return read_pattern_file(sensor.file("pattern"), 1.0 / rate_hz);
}

sense::RayPattern read_pattern(SensorReader& sensor) {
  if (sensor.has("pattern")) return read_named_pattern(sensor);
  sense::SpinSpec spin;
  spin.from_rad = sensor.angle("from_deg");
  spin.step_rad = sensor.angle("step_deg") * (sensor.flag("clockwise") ? -1.0 : 1.0);
  spin.columns = sensor.whole("columns");
  const double lowest = sensor.angle("lowest_deg"), highest = sensor.angle("highest_deg");
  spin.elevations_rad = sense::equal_elevations(lowest, highest, sensor.whole("rings"));
  try {
    return sense::spinning_pattern(spin);
  } catch (const Error& error) {
    throw sensor.error("columns", error.message());
  }
}

sense::LidarSpec read_lidar(const std::string& name, SensorReader& sensor) {
  sense::LidarSpec spec;
  spec.name = name;
  spec.pattern = read_pattern(sensor);
  spec.min_range_m = sensor.number("min_range_m");
  spec.max_range_m = sensor.number("max_range_m");
  sensor.check_ranges(spec.min_range_m, spec.max_range_m);
  if (spec.max_range_m == 0.0) throw sensor.error("max_range_m", "must be above 0");
  spec.response = {.noise_m = sensor.number("noise_m"),
                   .noise_per_m = sensor.number("noise_per_m"),
                   .noise_incidence = sensor.angle("noise_incidence_deg"),
                   .dropout = sensor.number("dropout"),
                   .dropout_at_max = sensor.number("dropout_at_max"),
                   .dropout_incidence = sensor.number("dropout_incidence"),
                   .intensity_noise = sensor.number("intensity_noise")};
  spec.beam = {.divergence_rad = sensor.angle("beam_deg"), .pulse_m = sensor.number("pulse_m")};
  spec.returns = sensor.whole("returns");
  spec.skew = sensor.flag("skew");
  spec.own_body = sensor.flag("own_body");
  spec.true_ranges = sensor.flag("true_ranges");
  if (sensor.has("labels")) spec.labels = sensor.flag("labels");
  spec.T_body_sensor.t = sensor.position();
  spec.T_body_sensor.q = sensor.orientation();
  spec.timing = sensor.timing();
  return spec;
}

/// Key and value as a map has them.
using PresetKey = std::pair<std::string_view, std::string_view>;

// Named for classes of hardware: values as their data sheets have them.
constexpr std::array kLidar16{
    PresetKey{"rate_hz", "10"},      PresetKey{"rings", "16"},          PresetKey{"lowest_deg", "-15"},
    PresetKey{"highest_deg", "15"},  PresetKey{"columns", "1800"},      PresetKey{"step_deg", "0.2"},
    PresetKey{"min_range_m", "0.5"}, PresetKey{"max_range_m", "100"},   PresetKey{"noise_m", "0.02"},
    PresetKey{"beam_deg", "0"},      PresetKey{"dropout_at_max", "0.2"}};
constexpr std::array kLidar64{PresetKey{"rate_hz", "10"},       PresetKey{"rings", "64"},
                              PresetKey{"lowest_deg", "-24.8"}, PresetKey{"highest_deg", "2"},
                              PresetKey{"columns", "2048"},     PresetKey{"step_deg", "0.17578125"},
                              PresetKey{"min_range_m", "0.9"},  PresetKey{"max_range_m", "120"},
                              PresetKey{"noise_m", "0.02"},     PresetKey{"dropout_at_max", "0.3"}};
constexpr std::array kLidar2d{PresetKey{"rate_hz", "40"},     PresetKey{"rings", "1"},
                              PresetKey{"lowest_deg", "0"},   PresetKey{"highest_deg", "0"},
                              PresetKey{"columns", "1081"},   PresetKey{"step_deg", "0.25"},
                              PresetKey{"from_deg", "-135"},  PresetKey{"min_range_m", "0.1"},
                              PresetKey{"max_range_m", "30"}, PresetKey{"noise_m", "0.01"}};

// Densities and walks of a consumer's and of a tactical grade unit.
constexpr std::array kImuMems{PresetKey{"rate_hz", "200"},      PresetKey{"gyro_noise", "1.7e-4"},
                              PresetKey{"gyro_walk", "2e-5"},   PresetKey{"gyro_bias_sigma", "0.01"},
                              PresetKey{"gyro_limit", "34.9"},  PresetKey{"force_noise", "2e-3"},
                              PresetKey{"force_walk", "3e-3"},  PresetKey{"force_bias_sigma", "0.1"},
                              PresetKey{"force_limit", "156.9"}};
constexpr std::array kImuTactical{PresetKey{"rate_hz", "200"},     PresetKey{"gyro_noise", "3.5e-5"},
                                  PresetKey{"gyro_walk", "4e-7"},  PresetKey{"gyro_bias_sigma", "5e-5"},
                                  PresetKey{"gyro_limit", "8.7"},  PresetKey{"force_noise", "3e-4"},
                                  PresetKey{"force_walk", "3e-5"}, PresetKey{"force_bias_sigma", "5e-3"},
                                  PresetKey{"force_limit", "98"}};
constexpr std::array kPresets{
    SensorPreset{"lidar", "lidar16", kLidar16}, SensorPreset{"lidar", "lidar64", kLidar64},
    SensorPreset{"lidar", "lidar2d_270", kLidar2d}, SensorPreset{"imu", "imu_mems", kImuMems},
    SensorPreset{"imu", "imu_tactical", kImuTactical}};

/// A table with what its preset says where it says nothing itself.
TomlTable with_preset(const TomlTable& table) {
  const TomlNode* preset = find(table, "preset");
  const auto* name = preset != nullptr ? std::get_if<std::string>(&preset->value) : nullptr;
  TomlTable filled = table;
  if (name == nullptr) return filled;
  const std::string kind = sensor_kind(table);
  const auto found = std::ranges::find_if(
      kPresets, [&](const SensorPreset& known) { return known.kind == kind && known.name == *name; });
  if (found == kPresets.end()) return filled;
  const bool has_pattern = find(filled, "pattern") != nullptr;
  for (const auto& [key, value] : found->values) {
    if (find(filled, key) != nullptr) continue;
    if (has_pattern && std::ranges::find(kSpinKeys, key) != kSpinKeys.end()) continue;
    TomlNode node = scenario_value(map::sensor_key(kind, key), std::string(value));
    node.line = preset->line;
    node.file = preset->file;
    assign(filled, key, std::move(node));
  }
  return filled;
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
  if (kind != "imu" && kind != "lidar") return read_points(name, sensor);
  sensor.choice("preset");
  if (kind == "imu") return read_inertial(name, sensor, false);
  return read_lidar(name, sensor);
}

}  // namespace

std::span<const SensorPreset> sensor_presets() {
  return kPresets;
}

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
