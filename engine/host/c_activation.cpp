// SPDX-License-Identifier: MIT
#include "host/c_activation.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "host/c_sensor.hpp"
#include "host/load/info_text.hpp"

namespace hallway::host {
namespace {

void expect(bool condition, const char* otherwise) {
  if (!condition) throw Error(ErrorCode::kIo, otherwise);
}

void expect_none(const std::string& problem) {
  if (!problem.empty()) throw Error(ErrorCode::kIo, problem);
}

/// The elements of a list of the ABI, each with the members that are known here.
template <typename Element>
std::vector<Element> elements_of(const void* first, std::uint64_t count, std::uint32_t stride) {
  expect(count <= kMaxIntrinsicParts, "intrinsics of more than 256 parts");
  expect(count == 0 || first != nullptr, "intrinsics whose list is null");
  expect(count == 0 || (stride >= sizeof(Element) && stride % 8 == 0), "intrinsics with a wrong stride");
  std::vector<Element> elements;
  for (std::uint64_t i = 0; i < count; ++i)
    elements.push_back(load<Element>(static_cast<const char*>(first) + i * stride));
  return elements;
}

EncoderIntrinsics encoder_of(const hw_encoder_info_t& info) {
  expect(HW_HAS(&info, hw_encoder_info_t, wheels), "intrinsics of a wrong size");
  EncoderIntrinsics encoder;
  for (const auto& from : elements_of<hw_encoder_wheel_t>(info.wheels, info.count, info.stride)) {
    EncoderWheel& wheel = encoder.wheels.emplace_back();
    wheel.m_per_tick = from.m_per_tick;
    std::ranges::copy(from.position, wheel.position.begin());
    std::ranges::copy(from.direction, wheel.direction.begin());
  }
  return encoder;
}

BumpIntrinsics bump_of(const hw_bump_info_t& info) {
  expect(HW_HAS(&info, hw_bump_info_t, zones), "intrinsics of a wrong size");
  BumpIntrinsics bump;
  for (const auto& zone : elements_of<hw_bump_zone_info_t>(info.zones, info.count, info.stride)) {
    expect(zone.name != nullptr, "a zone whose name is null");
    bump.zones.push_back(
        {.name = printable({zone.name, strnlen(zone.name, kMaxInfoTextBytes)}, kMaxInfoTextBytes),
         .middle_rad = zone.middle_rad,
         .width_rad = zone.width_rad,
         .bottom_m = zone.bottom_m,
         .top_m = zone.top_m});
  }
  return bump;
}

RangeScanIntrinsics range_scan_of(const hw_range_scan_info_t& info) {
  expect(HW_HAS(&info, hw_range_scan_info_t, scan_s), "intrinsics of a wrong size");
  return {.width = info.width,
          .height = info.height,
          .layers = info.layers,
          .beam_rad = info.beam_rad,
          .scan_s = info.scan_s};
}

ImuIntrinsics imu_of(const hw_imu_info_t& info) {
  expect(HW_HAS(&info, hw_imu_info_t, max_force_m_s2), "intrinsics of a wrong size");
  ImuIntrinsics imu;
  for (const ImuNumber& number : imu_numbers()) imu.*number.host = info.*number.abi;
  return imu;
}

GnssIntrinsics gnss_of(const hw_gnss_info_t& info) {
  expect(HW_HAS(&info, hw_gnss_info_t, altitude_m), "intrinsics of a wrong size");
  return {
      .latitude_deg = info.latitude_deg, .longitude_deg = info.longitude_deg, .altitude_m = info.altitude_m};
}

hw_encoder_wheel_t c_wheel(const EncoderWheel& from) {
  hw_encoder_wheel_t wheel{};
  wheel.m_per_tick = from.m_per_tick;
  std::ranges::copy(from.position, wheel.position);
  std::ranges::copy(from.direction, wheel.direction);
  return wheel;
}

hw_drive_info_t c_drive(const DriveInfo& drive) {
  hw_drive_info_t info{};
  info.size = sizeof info;
  info.kind = drive.kind;
  for (const DriveNumber& number : drive_numbers()) info.*number.abi = drive.*number.host;
  return info;
}

}  // namespace

CActivation::CActivation(Activation facts) : facts_(std::move(facts)) {
  for (const SensorInfo& sensor : facts_.sensors) {
    hw_sensor_info_t& info = sensors_.emplace_back();
    info.size = sizeof info;
    info.name = sensor.name.c_str();
    copy_sensor_facts(sensor, info);
    info.intrinsics = intrinsics(sensor);
    info.rate_hz = sensor.rate_hz;
    info.latency_s = sensor.latency_s;
    std::ranges::copy(sensor.noise_per_m, info.noise_per_m);
  }
  for (const hw_sensor_info_t& sensor : sensors_) pointers_.push_back(&sensor);
  activation_.size = sizeof activation_;
  activation_.n_sensors = static_cast<std::uint32_t>(pointers_.size());
  activation_.sensors = pointers_.data();
  if (facts_.drive) {
    drive_ = c_drive(*facts_.drive);
    activation_.drive = &drive_;
  }
  if (facts_.body) {
    add_body(*facts_.body);
    activation_.body = &body_;
  }
}

const void* CActivation::intrinsics(const SensorInfo& sensor) {
  if (const auto* encoder = std::get_if<EncoderIntrinsics>(&sensor.intrinsics)) {
    std::vector<hw_encoder_wheel_t>& wheels = wheels_.emplace_back();
    for (const EncoderWheel& wheel : encoder->wheels) wheels.push_back(c_wheel(wheel));
    hw_encoder_info_t& info = encoders_.emplace_back();
    info.size = sizeof info;
    info.stride = sizeof(hw_encoder_wheel_t);
    info.count = wheels.size();
    info.wheels = wheels.data();
    return &info;
  }
  if (const auto* bump = std::get_if<BumpIntrinsics>(&sensor.intrinsics)) {
    std::vector<hw_bump_zone_info_t>& zones = zones_.emplace_back();
    for (const BumpZoneInfo& zone : bump->zones)
      zones.push_back({zone.name.c_str(), zone.middle_rad, zone.width_rad, zone.bottom_m, zone.top_m});
    hw_bump_info_t& info = bumps_.emplace_back();
    info.size = sizeof info;
    info.stride = sizeof(hw_bump_zone_info_t);
    info.count = zones.size();
    info.zones = zones.data();
    return &info;
  }
  if (const auto* scan = std::get_if<RangeScanIntrinsics>(&sensor.intrinsics)) {
    hw_range_scan_info_t& info = scans_.emplace_back();
    info.size = sizeof info;
    info.width = scan->width;
    info.height = scan->height;
    info.layers = scan->layers;
    info.beam_rad = scan->beam_rad;
    info.scan_s = scan->scan_s;
    return &info;
  }
  if (const auto* imu = std::get_if<ImuIntrinsics>(&sensor.intrinsics)) {
    hw_imu_info_t& info = imus_.emplace_back();
    info.size = sizeof info;
    for (const ImuNumber& number : imu_numbers()) info.*number.abi = imu->*number.host;
    return &info;
  }
  if (const auto* gnss = std::get_if<GnssIntrinsics>(&sensor.intrinsics)) {
    hw_gnss_info_t& info = receivers_.emplace_back();
    info.size = sizeof info;
    info.latitude_deg = gnss->latitude_deg;
    info.longitude_deg = gnss->longitude_deg;
    info.altitude_m = gnss->altitude_m;
    return &info;
  }
  return nullptr;
}

void CActivation::add_body(const BodyInfo& body) {
  for (const auto& corner : body.corners) corners_.insert(corners_.end(), corner.begin(), corner.end());
  body_.size = sizeof body_;
  body_.n_corners = static_cast<std::uint32_t>(body.corners.size());
  body_.corners = corners_.empty() ? nullptr : corners_.data();
  body_.radius_m = outer_radius_m(body);
  body_.bottom_m = body.bottom_m;
  body_.top_m = body.top_m;
}

void CActivation::fill(hw_robot_info_t& robot) const {
  robot.sensors = activation_.sensors;
  robot.n_sensors = activation_.n_sensors;
  robot.drive = activation_.drive;
  robot.body = activation_.body;
}

DriveInfo drive_of(const hw_drive_info_t& info) {
  expect(HW_HAS(&info, hw_drive_info_t, dead_band_rad_s), "a drive of a wrong size");
  DriveInfo drive;
  drive.kind = info.kind < kDriveNames.size() ? info.kind : std::uint32_t{HW_DRIVE_UNKNOWN};
  for (const DriveNumber& number : drive_numbers()) drive.*number.host = info.*number.abi;
  const std::string problem = problem_of(drive);
  if (!problem.empty()) throw Error(ErrorCode::kIo, "a drive whose " + problem);
  return drive;
}

BodyInfo body_of(const hw_body_info_t& info) {
  expect(HW_HAS(&info, hw_body_info_t, top_m), "a body of a wrong size");
  expect(info.n_corners <= kMaxBodyCorners, "a body of more than 256 corners");
  expect(info.n_corners == 0 || info.corners != nullptr, "a body whose corners are null");
  BodyInfo body{.corners = {}, .radius_m = info.radius_m, .bottom_m = info.bottom_m, .top_m = info.top_m};
  for (std::uint32_t i = 0; i < info.n_corners; ++i) {
    const double* corner = hw_body_corner(&info, i);
    body.corners.push_back({corner[0], corner[1]});
  }
  expect_none(problem_of(body));
  return body;
}

void take_later_facts(const hw_sensor_info_t& info, SensorInfo& sensor) {
  sensor.rate_hz = hw_rate_hz_of(&info);
  sensor.latency_s = hw_latency_s_of(&info);
  for (std::uint32_t axis = 0; axis < 3; ++axis) sensor.noise_per_m[axis] = hw_noise_per_m_of(&info, axis);
  if (const hw_encoder_info_t* encoder = hw_encoder_info_of(&info)) sensor.intrinsics = encoder_of(*encoder);
  if (const hw_bump_info_t* bump = hw_bump_info_of(&info)) sensor.intrinsics = bump_of(*bump);
  if (const hw_range_scan_info_t* scan = hw_range_scan_info_of(&info))
    sensor.intrinsics = range_scan_of(*scan);
  if (const hw_imu_info_t* imu = hw_imu_info_of(&info)) sensor.intrinsics = imu_of(*imu);
  if (const hw_gnss_info_t* gnss = hw_gnss_info_of(&info)) sensor.intrinsics = gnss_of(*gnss);
  expect_none(problem_of(sensor));
}

}  // namespace hallway::host
