// SPDX-License-Identifier: MIT
#include "conformance/ordinary_robot.hpp"

#include <vector>

#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

constexpr double kCorners[] = {0.2, -0.15, 0.2, 0.15, -0.2, 0.15, -0.2, -0.15};
constexpr double kWholeTurn = 6.283185307179586;

hw_encoder_info_t make_wheels() {
  static const std::vector<hw_encoder_wheel_t> kWheels = [] {
    std::vector<hw_encoder_wheel_t> wheels(kWalkElements);
    for (std::size_t i = 0; i < wheels.size(); ++i)
      wheels[i] = {3e-4, {0.0, i % 2 == 0 ? 0.15 : -0.15, -0.03}, {1.0, 0.0, 0.0}};
    return wheels;
  }();
  return {sizeof(hw_encoder_info_t), sizeof(hw_encoder_wheel_t), kWheels.size(), kWheels.data()};
}

hw_bump_info_t make_zones() {
  static const std::vector<hw_bump_zone_info_t> kZones = [] {
    std::vector<hw_bump_zone_info_t> zones(kWalkElements);
    const double width = kWholeTurn / static_cast<double>(zones.size());
    for (std::size_t i = 0; i < zones.size(); ++i)
      zones[i] = {"zone", (static_cast<double>(i) + 0.5) * width, width, 0.0, 0.3};
    return zones;
  }();
  return {sizeof(hw_bump_info_t), sizeof(hw_bump_zone_info_t), kZones.size(), kZones.data()};
}

}  // namespace

RobotFacts ordinary_robot() {
  hw_drive_info_t drive{};
  drive.size = sizeof drive;
  drive.kind = HW_DRIVE_DIFFERENTIAL;
  drive.max_speed_m_s = 0.6;
  drive.max_lateral_m_s = 0.0;
  drive.max_angular_rad_s = 2.0;
  drive.max_acceleration_m_s2 = drive.max_deceleration_m_s2 = 1.0;
  drive.max_angular_acceleration_rad_s2 = 4.0;
  drive.greatest_steering_rad = drive.max_steering_rate_rad_s = 0.5;
  drive.wheel_base_m = 0.3;
  drive.axle_distance_m = 0.2;
  drive.wheel_radius_m = 0.05;
  drive.latency_s = 0.02;
  drive.dead_band_m_s = drive.dead_band_rad_s = 0.01;
  hw_body_info_t body{};
  body.size = sizeof body;
  body.n_corners = 4;
  body.corners = kCorners;
  body.radius_m = 0.25;
  body.bottom_m = 0.0;
  body.top_m = 0.3;
  return {drive, body};
}

const void* ordinary_intrinsics(std::uint32_t kind) {
  static const hw_encoder_info_t kEncoder = make_wheels();
  static const hw_bump_info_t kBump = make_zones();
  static const hw_range_scan_info_t kScan{
      sizeof kScan, static_cast<std::uint32_t>(kWalkElements / 2), 2, 1, 0.003, 0.04};
  static const hw_imu_info_t kImu{sizeof kImu, 0, 9.81, 1e-3, 1e-5, 1e-2, 1e-4, 10.0, 100.0};
  static const hw_gnss_info_t kGnss{sizeof kGnss, 0, 50.0, 8.0, 100.0};
  switch (kind) {
    case HW_SAMPLE_GNSS:
      return &kGnss;
    case HW_SAMPLE_ENCODER:
      return &kEncoder;
    case HW_SAMPLE_BUMP:
      return &kBump;
    case HW_SAMPLE_RANGE_SCAN:
      return &kScan;
    case HW_SAMPLE_IMU:
      return &kImu;
    default:
      return nullptr;
  }
}

}  // namespace hallway::conformance
