// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "host/plugin_table.hpp"
#include "map/sensors.hpp"
#include "sense/detection.hpp"
#include "sense/timing.hpp"
#include "sim/schema.hpp"
#include "sim/table_reader.hpp"

namespace hallway::sim {

/// Reads keys of a sensor of one kind, whose ranges and defaults are those of a map's.
class SensorReader {
 public:
  SensorReader(TableReader& table, std::string_view kind) : table_(table), kind_(kind) {}

  bool has(const char* key) const { return table_.has(key); }
  double number(const char* key) { return table_.number(key, range(key), parse_double(spec(key).fallback)); }
  double angle(const char* key) { return number(key) * std::numbers::pi / 180.0; }
  bool flag(const char* key) { return table_.flag(key, spec(key).fallback == "1"); }
  std::uint32_t whole(const char* key) {
    const map::KeySpec& known = spec(key);
    return static_cast<std::uint32_t>(table_.whole(key, std::llround(known.low), std::llround(known.high),
                                                   parse_int(std::string(known.fallback))));
  }
  Vec3 one_or_three(const char* key) { return table_.vector_or_one(key, range(key), Vec3::Zero()); }
  std::vector<double> list(const char* key, std::size_t most) { return table_.list(key, range(key), most); }
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
  /// Where the sensor is, turned about z alone where its kind has no other angles, and when it measures.
  template <typename Spec>
  void place(Spec& spec) {
    spec.T_body_sensor.t = position();
    spec.T_body_sensor.q =
        is_known("pitch_deg") ? orientation() : from_yaw_pitch_roll(angle("yaw_deg"), 0.0, 0.0);
    spec.timing = timing();
  }
  sense::DetectionSpec detection() {
    return {.dropout = number_if_told("dropout"), .clutter = number_if_told("clutter")};
  }
  /// The true mount in the frame of the one that is told; none where they are the same.
  std::optional<Pose> mount_error() {
    if (!has("mount_error_m") && !has("mount_error_deg")) return std::nullopt;
    Pose error;
    error.t = table_.vector("mount_error_m", range("mount_error_m"), Vec3::Zero());
    const Vec3 turn =
        table_.vector("mount_error_deg", range("mount_error_deg"), Vec3::Zero()) * std::numbers::pi / 180.0;
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
  bool is_known(const char* key) const {
    return map::find_entity_spec("hw_sensor")->key(key, kind_) != nullptr;
  }
  const map::KeySpec& spec(const char* key) const { return map::sensor_key(kind_, key); }
  Range range(const char* key) const { return {spec(key).low, spec(key).high, spec(key).above_low}; }

  TableReader& table_;
  std::string_view kind_;
};

}  // namespace hallway::sim
