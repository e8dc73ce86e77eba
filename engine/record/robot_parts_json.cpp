// SPDX-License-Identifier: MIT
#include "record/robot_parts_json.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::record {
namespace {

using Json = nlohmann::ordered_json;

Json number_json(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// NaN where it is null or missing.
double number_in(const Json& json, std::string_view key) {
  const auto found = json.find(key);
  return found == json.end() || found->is_null() ? host::DriveInfo::kUnknown : found->get<double>();
}

template <std::size_t N>
Json vector_json(const std::array<double, N>& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(number_json(value));
  return json;
}

std::array<double, 3> vector_in(const Json& json, const char* key) {
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Json& value = json.at(key).at(i);
    values[i] = value.is_null() ? host::DriveInfo::kUnknown : value.get<double>();
  }
  return values;
}

void require_sound_part(const std::string& problem, const char* element) {
  if (!problem.empty()) throw Error(ErrorCode::kBadInput, problem, {.element = element});
}

/// Turns what the JSON library says of a wrong member into an error of ours.
template <typename Read>
auto read_part(const char* element, Read read) {
  try {
    return read();
  } catch (const nlohmann::json::exception& failure) {
    throw Error(ErrorCode::kBadInput, printable(failure.what()), {.element = element});
  }
}

}  // namespace

Json print_drive(const host::DriveInfo& drive) {
  Json json{{"kind", host::kDriveNames.at(drive.kind)}};
  for (const host::DriveNumber& number : host::drive_numbers())
    json[std::string(number.key)] = number_json(drive.*number.host);
  return json;
}

Json print_body(const host::BodyInfo& body) {
  Json json = Json::object();
  if (!body.corners.empty()) json["corners_m"] = body.corners;
  json["radius_m"] = number_json(host::outer_radius_m(body));
  json["bottom_m"] = number_json(body.bottom_m);
  json["top_m"] = number_json(body.top_m);
  return json;
}

Json print_intrinsics(const host::Intrinsics& intrinsics) {
  if (const auto* bump = std::get_if<host::BumpIntrinsics>(&intrinsics)) {
    Json zones = Json::array();
    for (const host::BumpZoneInfo& zone : bump->zones)
      zones.push_back({{"name", zone.name},
                       {"middle_rad", number_json(zone.middle_rad)},
                       {"width_rad", number_json(zone.width_rad)},
                       {"bottom_m", number_json(zone.bottom_m)},
                       {"top_m", number_json(zone.top_m)}});
    return {{"zones", std::move(zones)}};
  }
  if (const auto* encoder = std::get_if<host::EncoderIntrinsics>(&intrinsics)) {
    Json wheels = Json::array();
    for (const host::EncoderWheel& wheel : encoder->wheels)
      wheels.push_back({{"m_per_tick", number_json(wheel.m_per_tick)},
                        {"position_m", vector_json(wheel.position)},
                        {"direction", vector_json(wheel.direction)}});
    return {{"wheels", std::move(wheels)}};
  }
  if (const auto* scan = std::get_if<host::RangeScanIntrinsics>(&intrinsics)) {
    return {{"width", scan->width},
            {"height", scan->height},
            {"layers", scan->layers},
            {"beam_rad", number_json(scan->beam_rad)},
            {"scan_s", number_json(scan->scan_s)}};
  }
  if (const auto* imu = std::get_if<host::ImuIntrinsics>(&intrinsics)) {
    Json json = Json::object();
    for (const host::ImuNumber& number : host::imu_numbers())
      json[std::string(number.key)] = number_json(imu->*number.host);
    return json;
  }
  if (const auto* gnss = std::get_if<host::GnssIntrinsics>(&intrinsics)) {
    return {{"latitude_deg", number_json(gnss->latitude_deg)},
            {"longitude_deg", number_json(gnss->longitude_deg)},
            {"altitude_m", number_json(gnss->altitude_m)}};
  }
  return nullptr;
}

std::optional<host::DriveInfo> read_drive_in(const Json& activation) {
  return read_part("drive", [&]() -> std::optional<host::DriveInfo> {
    if (!activation.contains("drive")) return std::nullopt;
    const Json& json = activation["drive"];
    host::DriveInfo drive;
    drive.kind = host::drive_kind(json.at("kind").get<std::string>()).value_or(HW_DRIVE_UNKNOWN);
    for (const host::DriveNumber& number : host::drive_numbers())
      drive.*number.host = number_in(json, number.key);
    require_sound_part(host::problem_of(drive), "drive");
    return drive;
  });
}

std::optional<host::BodyInfo> read_body_in(const Json& activation) {
  return read_part("body", [&]() -> std::optional<host::BodyInfo> {
    if (!activation.contains("body")) return std::nullopt;
    const Json& json = activation["body"];
    host::BodyInfo body{.corners = json.value("corners_m", decltype(host::BodyInfo::corners){}),
                        .radius_m = number_in(json, "radius_m"),
                        .bottom_m = number_in(json, "bottom_m"),
                        .top_m = number_in(json, "top_m")};
    require_sound_part(host::problem_of(body), "body");
    return body;
  });
}

void read_intrinsics(const Json& json, host::SensorInfo& sensor) {
  read_part("intrinsics", [&] {
    if (json.contains("zones")) {
      host::BumpIntrinsics& bump = sensor.intrinsics.emplace<host::BumpIntrinsics>();
      for (const Json& zone : json["zones"])
        bump.zones.push_back({.name = zone.at("name").get<std::string>(),
                              .middle_rad = number_in(zone, "middle_rad"),
                              .width_rad = number_in(zone, "width_rad"),
                              .bottom_m = number_in(zone, "bottom_m"),
                              .top_m = number_in(zone, "top_m")});
    } else if (json.contains("wheels")) {
      host::EncoderIntrinsics& encoder = sensor.intrinsics.emplace<host::EncoderIntrinsics>();
      for (const Json& wheel : json["wheels"])
        encoder.wheels.push_back({.m_per_tick = number_in(wheel, "m_per_tick"),
                                  .position = vector_in(wheel, "position_m"),
                                  .direction = vector_in(wheel, "direction")});
    } else if (json.contains("beam_rad")) {
      sensor.intrinsics = host::RangeScanIntrinsics{.width = json.at("width").get<std::uint32_t>(),
                                                    .height = json.at("height").get<std::uint32_t>(),
                                                    .layers = json.at("layers").get<std::uint32_t>(),
                                                    .beam_rad = number_in(json, "beam_rad"),
                                                    .scan_s = number_in(json, "scan_s")};
    } else if (json.contains("gravity_m_s2")) {
      host::ImuIntrinsics& imu = sensor.intrinsics.emplace<host::ImuIntrinsics>();
      for (const host::ImuNumber& number : host::imu_numbers())
        imu.*number.host = number_in(json, number.key);
    } else if (json.contains("latitude_deg")) {
      sensor.intrinsics = host::GnssIntrinsics{.latitude_deg = number_in(json, "latitude_deg"),
                                               .longitude_deg = number_in(json, "longitude_deg"),
                                               .altitude_m = number_in(json, "altitude_m")};
    }
    require_sound_part(host::problem_of_intrinsics(sensor), "intrinsics");
  });
}

}  // namespace hallway::record
