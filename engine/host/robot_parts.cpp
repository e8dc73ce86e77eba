// SPDX-License-Identifier: MIT
#include "host/robot_parts.hpp"

#include <hallway/sample.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hallway::host {
namespace {

#define HALLWAY_DRIVE_NUMBER(member)                      \
  DriveNumber {                                           \
#member, &DriveInfo::member, &hw_drive_info_t::member \
  }
constexpr std::array kDriveNumbers{
    HALLWAY_DRIVE_NUMBER(max_speed_m_s),         HALLWAY_DRIVE_NUMBER(max_lateral_m_s),
    HALLWAY_DRIVE_NUMBER(max_angular_rad_s),     HALLWAY_DRIVE_NUMBER(max_acceleration_m_s2),
    HALLWAY_DRIVE_NUMBER(max_deceleration_m_s2), HALLWAY_DRIVE_NUMBER(max_angular_acceleration_rad_s2),
    HALLWAY_DRIVE_NUMBER(greatest_steering_rad), HALLWAY_DRIVE_NUMBER(max_steering_rate_rad_s),
    HALLWAY_DRIVE_NUMBER(wheel_base_m),          HALLWAY_DRIVE_NUMBER(axle_distance_m),
    HALLWAY_DRIVE_NUMBER(wheel_radius_m),        HALLWAY_DRIVE_NUMBER(latency_s),
    HALLWAY_DRIVE_NUMBER(dead_band_m_s),         HALLWAY_DRIVE_NUMBER(dead_band_rad_s)};
#undef HALLWAY_DRIVE_NUMBER

#define HALLWAY_IMU_NUMBER(member)                          \
  ImuNumber {                                               \
#member, &ImuIntrinsics::member, &hw_imu_info_t::member \
  }
constexpr std::array kImuNumbers{HALLWAY_IMU_NUMBER(gravity_m_s2),  HALLWAY_IMU_NUMBER(angular_noise),
                                 HALLWAY_IMU_NUMBER(angular_walk),  HALLWAY_IMU_NUMBER(force_noise),
                                 HALLWAY_IMU_NUMBER(force_walk),    HALLWAY_IMU_NUMBER(max_angular_rad_s),
                                 HALLWAY_IMU_NUMBER(max_force_m_s2)};
#undef HALLWAY_IMU_NUMBER

constexpr double kUnitTolerance = 1e-6;
constexpr double kTurnTolerance = 1e-9;

bool is_known_or_nan(double value) {
  return !std::isinf(value);
}

bool is_size(double value) {
  return std::isnan(value) || (value >= 0.0 && std::isfinite(value));
}

bool are_heights(double bottom_m, double top_m) {
  return is_known_or_nan(bottom_m) && is_known_or_nan(top_m) && !(bottom_m > top_m);
}

using Corner = std::array<double, 2>;

/// Twice the area of the triangle a, b, c; above 0 where it turns to the left.
double turn(const Corner& a, const Corner& b, const Corner& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Whether each corner turns to the left, and all of them once around: then every corner is left of every edge, and of no edge but its own two on it.
bool is_convex(std::span<const Corner> corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Corner& from = corners[i];
    const Corner& to = corners[(i + 1) % n];
    for (std::size_t k = 2; k < n; ++k) {
      if (!(turn(from, to, corners[(i + k) % n]) > 0.0)) return false;
    }
  }
  return true;
}

std::string problem_of(const EncoderIntrinsics& encoder) {
  if (encoder.wheels.size() > kMaxIntrinsicParts) return "too many wheels";
  for (const EncoderWheel& wheel : encoder.wheels) {
    if (!(std::isnan(wheel.m_per_tick) || (wheel.m_per_tick > 0.0 && std::isfinite(wheel.m_per_tick))))
      return "metres per tick that are not above 0";
    if (!std::ranges::all_of(wheel.position, is_known_or_nan)) return "a wheel at a place that is not finite";
    const auto& d = wheel.direction;
    const double length = std::hypot(d[0], d[1], d[2]);
    if (!(std::isnan(length) || std::abs(length - 1.0) <= kUnitTolerance))
      return "a wheel's direction that is not of unit length";
  }
  return {};
}

std::string problem_of(const BumpIntrinsics& bump) {
  if (bump.zones.size() > kMaxIntrinsicParts) return "too many zones";
  for (const BumpZoneInfo& zone : bump.zones) {
    if (!is_known_or_nan(zone.middle_rad)) return "a zone with a direction that is not finite";
    if (!(std::isnan(zone.width_rad) ||
          (zone.width_rad > 0.0 && zone.width_rad <= 2.0 * std::numbers::pi + kTurnTolerance)))
      return "a zone with a width that is not above 0 and at most a turn";
    if (!are_heights(zone.bottom_m, zone.top_m))
      return "a zone with heights that are not finite, or a bottom above its top";
  }
  return {};
}

std::string problem_of(const RangeScanIntrinsics& scan) {
  if ((scan.width == 0) != (scan.height == 0))
    return "a scan with rows and no columns, or columns and no rows";
  if (!is_size(scan.beam_rad)) return "a beam whose divergence is below 0 or not finite";
  if (!is_size(scan.scan_s)) return "a scan whose time is below 0 or not finite";
  return {};
}

std::string problem_of(const ImuIntrinsics& imu) {
  for (const ImuNumber& number : kImuNumbers) {
    if (!is_size(imu.*number.host))
      return std::string(number.key) + " is below 0 or not finite; NaN is for what is not known";
  }
  return {};
}

std::string problem_of(const GnssIntrinsics& gnss) {
  if (std::abs(gnss.latitude_deg) > 90.0) return "a latitude beyond a pole";
  if (std::abs(gnss.longitude_deg) > 180.0) return "a longitude beyond half a turn";
  if (std::isinf(gnss.altitude_m)) return "an altitude that is infinite";
  return {};
}

}  // namespace

std::span<const DriveNumber> drive_numbers() {
  return kDriveNumbers;
}

std::span<const ImuNumber> imu_numbers() {
  return kImuNumbers;
}

std::optional<std::uint32_t> drive_kind(std::string_view name) {
  const auto found = std::ranges::find(kDriveNames, name);
  if (found == kDriveNames.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - kDriveNames.begin());
}

double outer_radius_m(const BodyInfo& body) {
  if (body.corners.empty()) return body.radius_m;
  double radius = 0.0;
  for (const Corner& corner : body.corners) radius = std::max(radius, std::hypot(corner[0], corner[1]));
  return radius;
}

std::string problem_of(const DriveInfo& drive) {
  if (drive.kind >= kDriveNames.size()) return "a kind of drive that is not known";
  for (const DriveNumber& number : kDriveNumbers) {
    if (!is_size(drive.*number.host))
      return std::string(number.key) + " is below 0 or not finite; NaN is for what is not known";
  }
  return {};
}

std::string problem_of(const BodyInfo& body) {
  if (body.corners.size() > kMaxBodyCorners) return "a body of more than 256 corners";
  if (!body.corners.empty() && body.corners.size() < 3) return "a body of fewer than 3 corners";
  for (const Corner& corner : body.corners) {
    if (!std::ranges::all_of(corner, [](double value) { return std::isfinite(value); }))
      return "a body with a corner that is not finite";
  }
  if (!is_convex(body.corners)) return "a body whose corners are not convex and counter-clockwise";
  if (!is_size(body.radius_m)) return "a body with a radius below 0 or not finite";
  if (!are_heights(body.bottom_m, body.top_m))
    return "a body with heights that are not finite, or its bottom above its top";
  return {};
}

std::string problem_of_intrinsics(const SensorInfo& sensor) {
  if (const auto* bump = std::get_if<BumpIntrinsics>(&sensor.intrinsics))
    return sensor.kind == HW_SAMPLE_BUMP ? problem_of(*bump) : "zones of a sensor that is no bumper";
  if (const auto* encoder = std::get_if<EncoderIntrinsics>(&sensor.intrinsics))
    return sensor.kind == HW_SAMPLE_ENCODER ? problem_of(*encoder)
                                            : "wheels of a sensor that has no encoders";
  if (const auto* scan = std::get_if<RangeScanIntrinsics>(&sensor.intrinsics))
    return sensor.kind == HW_SAMPLE_RANGE_SCAN ? problem_of(*scan) : "scans of a sensor that has no rays";
  if (const auto* imu = std::get_if<ImuIntrinsics>(&sensor.intrinsics))
    return sensor.kind == HW_SAMPLE_IMU ? problem_of(*imu) : "noise of an IMU of a sensor that is none";
  if (const auto* gnss = std::get_if<GnssIntrinsics>(&sensor.intrinsics))
    return sensor.kind == HW_SAMPLE_GNSS ? problem_of(*gnss)
                                         : "a place on Earth of a sensor that is no receiver";
  return {};
}

std::string problem_of(const SensorInfo& sensor) {
  if (!is_size(sensor.rate_hz)) return "a rate below 0 or not finite";
  if (!is_size(sensor.latency_s)) return "a latency below 0 or not finite";
  if (!std::ranges::all_of(sensor.noise_per_m, is_size)) return "noise per metre below 0 or not finite";
  return problem_of_intrinsics(sensor);
}

}  // namespace hallway::host
