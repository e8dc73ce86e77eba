// SPDX-License-Identifier: MIT
#include "sense/describe.hpp"

#include <hallway/sample.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace hallway::sense {
namespace {

/// A pose as the ABI has it.
hw_pose_t abi_pose(const Pose& pose) {
  return {{pose.t.x(), pose.t.y(), pose.t.z()}, {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()}};
}

/// A height, unless it is the default, which is no end of the zone.
double height_or_unknown(double height_m, double default_m) {
  return height_m == default_m ? std::numeric_limits<double>::quiet_NaN() : height_m;
}

host::BumpZoneInfo zone_info(const BumpZone& zone) {
  constexpr double turn = 2.0 * std::numbers::pi;
  double width = std::fmod(zone.to_rad - zone.from_rad, turn);
  if (width <= 0.0) width += turn;
  const bool is_sector = zone.region.empty();
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  return {.name = zone.name,
          .middle_rad = is_sector ? std::remainder(zone.from_rad + 0.5 * width, turn) : kUnknown,
          .width_rad = is_sector ? width : kUnknown,
          .bottom_m = height_or_unknown(zone.bottom_m, BumpZone{}.bottom_m),
          .top_m = height_or_unknown(zone.top_m, BumpZone{}.top_m)};
}

/// The width about the head's x axis that a beam is within.
double width_about_middle(const EchoBeamSpec& beam) {
  if (beam.polygon.empty()) return beam.cone_rad;
  const EchoSpan span = echo_span(beam.polygon);
  const double beside = std::max(std::abs(span.from_rad), std::abs(span.from_rad + span.width_rad));
  return std::min(2.0 * beside, 2.0 * std::numbers::pi);
}

/// With when it measures.
host::SensorInfo timed(host::SensorInfo info, const SensorTiming& timing) {
  info.rate_hz = timing.rate_hz;
  info.latency_s = timing.latency_s;
  return info;
}

/// What all sensors that send beams have.
template <typename Spec>
host::SensorInfo ranging(const Spec& spec, std::uint32_t id, double noise_m) {
  host::SensorInfo info = timed({.id = id,
                                 .kind = HW_SAMPLE_RANGE_SCAN,
                                 .name = spec.name,
                                 .T_body_sensor = abi_pose(spec.T_body_sensor),
                                 .min_range_m = spec.min_range_m,
                                 .max_range_m = spec.max_range_m},
                                spec.timing);
  info.noise_m[0] = noise_m;
  return info;
}

}  // namespace

host::SensorInfo describe(const PointSensorSpec& spec, std::uint32_t id) {
  return {.id = id,
          .kind = HW_SAMPLE_POINTS,
          .name = spec.name,
          .T_body_sensor = abi_pose(spec.T_body_sensor),
          .horizontal_fov = spec.horizontal_fov,
          .vertical_fov = spec.vertical_fov,
          .min_range_m = spec.min_range_m,
          .max_range_m = spec.max_range_m,
          .noise_m = {spec.noise_m[0], spec.noise_m[1], spec.noise_m[2]}};
}

host::SensorInfo describe(const PlaneSensorSpec& spec, std::uint32_t id) {
  const bool level = spec.shape == PlaneShape::walls;  // their normals are
  return {.id = id,
          .kind = HW_SAMPLE_PLANES,
          .name = spec.name,
          .T_body_sensor = abi_pose(spec.T_body_sensor),
          .horizontal_fov = spec.view.horizontal_fov,
          .vertical_fov = spec.vertical_fov,
          .min_range_m = spec.view.min_range_m,
          .max_range_m = spec.view.max_range_m,
          .noise_m = {spec.noise_m, spec.noise_m, level ? 0.0 : spec.noise_m}};
}

host::SensorInfo describe(const BumpSensorSpec& spec, std::uint32_t id) {
  host::BumpIntrinsics zones;
  for (const BumpZone& zone : spec.zones) zones.zones.push_back(zone_info(zone));
  return {.id = id, .kind = HW_SAMPLE_BUMP, .name = spec.name, .intrinsics = std::move(zones)};
}

host::SensorInfo describe(const EncoderSensorSpec& spec, std::uint32_t id) {
  return {.id = id, .kind = HW_SAMPLE_ENCODER, .name = spec.name};
}

host::SensorInfo describe(const LidarSpec& spec, std::uint32_t id, double scan_s) {
  host::SensorInfo info = ranging(spec, id, spec.response.noise_m);
  info.noise_per_m[0] = spec.response.noise_per_m;
  info.intrinsics = host::RangeScanIntrinsics{.width = spec.pattern.width,
                                              .height = spec.pattern.height,
                                              .layers = spec.returns,
                                              .beam_rad = spec.beam.divergence_rad,
                                              .scan_s = scan_s};
  return info;
}

host::SensorInfo describe(const SonarSpec& spec, std::uint32_t id) {
  host::SensorInfo info = ranging(spec, id, spec.response.noise_m);
  info.noise_per_m[0] = spec.response.noise_per_m;
  info.intrinsics = host::RangeScanIntrinsics{.width = spec.pings.width,
                                              .height = spec.pings.height,
                                              .layers = spec.echoes,
                                              .beam_rad = width_about_middle(spec.beam),
                                              .scan_s = static_cast<double>(spec.sweep_ns) * 1e-9};
  return info;
}

host::SensorInfo describe(const InfraredSpec& spec, std::uint32_t id) {
  host::SensorInfo info = ranging(spec, id, spec.noise_m);
  info.intrinsics = host::RangeScanIntrinsics{.width = spec.rays.width,
                                              .height = spec.rays.height,
                                              .layers = 1,
                                              .scan_s = static_cast<double>(spec.duration_ns) * 1e-9};
  return info;
}

host::SensorInfo describe(const GnssSpec& spec, std::uint32_t id) {
  host::SensorInfo info = timed(
      {.id = id, .kind = HW_SAMPLE_GNSS, .name = spec.name, .T_body_sensor = abi_pose(spec.T_body_sensor)},
      spec.timing);
  info.noise_m[0] = info.noise_m[1] = std::hypot(spec.level.noise_m, spec.level.correlated_m);
  info.noise_m[2] = std::hypot(spec.height.noise_m, spec.height.correlated_m);
  return info;
}

host::SensorInfo describe(const CompassSpec& spec, std::uint32_t id) {
  return timed({.id = id,
                .kind = HW_SAMPLE_MAGNETIC,
                .name = spec.name,
                .T_body_sensor = abi_pose(spec.T_body_sensor)},
               spec.timing);
}

host::SensorInfo describe(const ImuSensorSpec& spec, std::uint32_t id) {
  host::SensorInfo info = timed(
      {.id = id, .kind = HW_SAMPLE_IMU, .name = spec.name, .T_body_sensor = abi_pose(spec.T_body_sensor)},
      spec.timing);
  const bool has_force = std::ranges::find(spec.accelerometer.axes, true) != spec.accelerometer.axes.end();
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const auto limit = [](double value) { return std::isfinite(value) ? value : kUnknown; };
  info.intrinsics =
      host::ImuIntrinsics{.gravity_m_s2 = spec.gravity_m_s2,
                          .angular_noise = spec.gyro.noise,
                          .angular_walk = spec.gyro.walk,
                          .force_noise = has_force ? spec.accelerometer.noise : kUnknown,
                          .force_walk = has_force ? spec.accelerometer.walk : kUnknown,
                          .max_angular_rad_s = limit(spec.gyro.limit),
                          .max_force_m_s2 = has_force ? limit(spec.accelerometer.limit) : kUnknown};
  return info;
}

host::SensorInfo describe(const WheelOdometrySpec& spec, std::uint32_t id) {
  return timed({.id = id, .kind = HW_SAMPLE_ODOMETRY, .name = spec.name}, spec.timing);
}

host::SensorInfo describe(const MouseOdometrySpec& spec, std::uint32_t id) {
  return timed({.id = id,
                .kind = HW_SAMPLE_ODOMETRY,
                .name = spec.name,
                .T_body_sensor = abi_pose(spec.T_body_sensor)},
               spec.timing);
}

}  // namespace hallway::sense
