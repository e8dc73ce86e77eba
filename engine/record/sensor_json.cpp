// SPDX-License-Identifier: MIT
#include "record/sensor_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/text.hpp"
#include "host/samples/sample_kind.hpp"
#include "record/robot_parts_json.hpp"

namespace hallway::record {
namespace {

using Json = nlohmann::ordered_json;

Json known(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

double number_or_unknown(const Json& value) {
  return value.is_null() ? host::SensorInfo::kUnknown : value.get<double>();
}

/// Turns what the JSON library says of a wrong member into an error of ours.
template <typename Read>
auto read_checked(const char* element, Read read) {
  try {
    return read();
  } catch (const nlohmann::json::exception& failure) {
    throw Error(ErrorCode::kBadInput, printable(failure.what()), {.file = "run.json", .element = element});
  }
}

}  // namespace

Json print_pose(const hw_pose_t& pose) {
  return {{"position_m", pose.position}, {"orientation_wxyz", pose.orientation}};
}

hw_pose_t read_pose(const Json& json) {
  return read_checked("pose", [&] {
    const auto t = json.at("position_m").get<std::array<double, 3>>();
    const auto q = json.at("orientation_wxyz").get<std::array<double, 4>>();
    return hw_pose_t{{t[0], t[1], t[2]}, {q[0], q[1], q[2], q[3]}};
  });
}

Json print_sensor(const host::SensorInfo& sensor) {
  Json json{{"name", sensor.name},
            {"kind", host::sample_kind_name(sensor.kind)},
            {"T_body_sensor", print_pose(sensor.T_body_sensor)},
            {"horizontal_fov_rad", known(sensor.horizontal_fov)},
            {"vertical_fov_rad", known(sensor.vertical_fov)},
            {"min_range_m", known(sensor.min_range_m)},
            {"max_range_m", known(sensor.max_range_m)},
            {"noise_m", {known(sensor.noise_m[0]), known(sensor.noise_m[1]), known(sensor.noise_m[2])}}};
  if (Json intrinsics = print_intrinsics(sensor.intrinsics); !intrinsics.is_null())
    json["intrinsics"] = std::move(intrinsics);
  if (!std::isnan(sensor.rate_hz)) json["rate_hz"] = sensor.rate_hz;
  if (!std::isnan(sensor.latency_s)) json["latency_s"] = sensor.latency_s;
  if (!std::ranges::all_of(sensor.noise_per_m, [](double noise) { return std::isnan(noise); }))
    json["noise_per_m"] = {known(sensor.noise_per_m[0]), known(sensor.noise_per_m[1]),
                           known(sensor.noise_per_m[2])};
  return json;
}

Json print_sensors(std::span<const host::SensorInfo> sensors) {
  Json list = Json::array();
  for (const host::SensorInfo& sensor : sensors) list.push_back(print_sensor(sensor));
  return list;
}

host::SensorInfo read_sensor(const Json& json) {
  return read_checked("sensor", [&] {
    host::SensorInfo sensor;
    sensor.name = json.at("name").get<std::string>();
    const auto name = json.value("kind", std::string(host::kPointSamples.name));
    const host::SampleKind* kind = host::find_sample_kind(name);
    if (kind == nullptr)
      throw Error(ErrorCode::kBadInput,
                  fmt::format("a sensor of `{}`, which this program does not know", printable(name)),
                  {.file = "run.json", .element = "sensor"});
    sensor.kind = kind->kind;
    sensor.T_body_sensor = read_pose(json.at("T_body_sensor"));
    sensor.horizontal_fov = number_or_unknown(json.at("horizontal_fov_rad"));
    sensor.vertical_fov = number_or_unknown(json.at("vertical_fov_rad"));
    sensor.min_range_m = number_or_unknown(json.at("min_range_m"));
    sensor.max_range_m = number_or_unknown(json.at("max_range_m"));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sensor.noise_m[axis] = number_or_unknown(json.at("noise_m").at(axis));
    }
    if (json.contains("intrinsics")) read_intrinsics(json["intrinsics"], sensor);
    if (json.contains("rate_hz")) sensor.rate_hz = number_or_unknown(json["rate_hz"]);
    if (json.contains("latency_s")) sensor.latency_s = number_or_unknown(json["latency_s"]);
    for (std::size_t axis = 0; axis < 3 && json.contains("noise_per_m"); ++axis)
      sensor.noise_per_m[axis] = number_or_unknown(json["noise_per_m"].at(axis));
    if (const std::string problem = host::problem_of(sensor); !problem.empty())
      throw Error(ErrorCode::kBadInput, problem, {.file = "run.json", .element = "sensor"});
    return sensor;
  });
}

std::vector<host::SensorInfo> read_sensors(const Json& json) {
  return read_checked("sensors", [&] {
    std::vector<host::SensorInfo> sensors;
    for (const Json& sensor : json) {
      sensors.push_back(read_sensor(sensor));
      sensors.back().id = sensor.value("id", std::uint32_t{0});
    }
    return sensors;
  });
}

}  // namespace hallway::record
