// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <hallway/sample.h>

#include <cmath>
#include <cstring>

#include "host/activation.hpp"

namespace hallway::test {

/// A robot of which all is known, each number another one, with encoders, a bumper, a sensor of points, one of rays, an IMU and a receiver of satellites.
inline host::Activation known_robot() {
  host::Activation robot;
  robot.sensors = {{.id = 4, .kind = HW_SAMPLE_ENCODER, .name = "wheels"},
                   {.id = 7, .kind = HW_SAMPLE_BUMP, .name = "bumper"},
                   {.id = 9, .kind = HW_SAMPLE_POINTS, .name = "eyes"},
                   {.id = 12, .kind = HW_SAMPLE_RANGE_SCAN, .name = "lidar"},
                   {.id = 13, .kind = HW_SAMPLE_IMU, .name = "imu"},
                   {.id = 15, .kind = HW_SAMPLE_GNSS, .name = "gnss"}};
  robot.sensors[0].intrinsics = host::EncoderIntrinsics{
      {{1.0 / 3.0, {0.1, 0.2, -0.3}, {1.0, 0.0, 0.0}}, {2.5e-4, {0.1, -0.2, -0.3}, {0.6, 0.8, 0.0}}}};
  robot.sensors[1].intrinsics =
      host::BumpIntrinsics{{{"front", 0.25, 1.5, 0.05, 0.3}, {"hinten links", -2.5, 0.1, NAN, NAN}}};
  robot.sensors[3].intrinsics = host::RangeScanIntrinsics{
      .width = 1800, .height = 16, .layers = 2, .beam_rad = 0.003, .scan_s = 1.0 / 9.0};
  double imu_number = 1.0 / 11.0;
  auto& imu = robot.sensors[4].intrinsics.emplace<host::ImuIntrinsics>();
  for (const host::ImuNumber& number : host::imu_numbers()) imu.*number.host = imu_number += 0.5;
  robot.sensors[5].intrinsics =
      host::GnssIntrinsics{.latitude_deg = -33.5, .longitude_deg = 151.25, .altitude_m = 1.0 / 3.0};
  // With intrinsics before them, and without.
  for (const std::size_t i : {1u, 2u, 3u}) {
    robot.sensors[i].rate_hz = 1e3 / (3.0 + static_cast<double>(i));
    robot.sensors[i].latency_s = 0.01 * static_cast<double>(i);
    robot.sensors[i].noise_per_m[i - 1] = 0.001 * static_cast<double>(i);
  }
  robot.sensors[4].rate_hz = 0.0;
  host::DriveInfo& drive = robot.drive.emplace();
  drive.kind = HW_DRIVE_OMNIDIRECTIONAL;
  double next = 1.0 / 7.0;
  for (const host::DriveNumber& number : host::drive_numbers()) drive.*number.host = next += 0.5;
  robot.body = host::BodyInfo{.corners = {{0.3, -0.2}, {0.3, 0.2}, {-0.1, 0.25}, {-0.3, 0.0}, {-0.1, -0.25}},
                              .bottom_m = -0.05,
                              .top_m = 0.45};
  robot.body->radius_m = host::outer_radius_m(*robot.body);
  return robot;
}

inline bool same_number(double a, double b) {
  return std::isnan(a) ? std::isnan(b) : a == b;
}

inline void expect_same_drive(const host::DriveInfo& a, const host::DriveInfo& b) {
  EXPECT_EQ(a.kind, b.kind);
  for (const host::DriveNumber& number : host::drive_numbers())
    EXPECT_TRUE(same_number(a.*number.host, b.*number.host)) << number.key;
}

inline void expect_same_body(const host::BodyInfo& a, const host::BodyInfo& b) {
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_TRUE(same_number(a.radius_m, b.radius_m));
  EXPECT_TRUE(same_number(a.bottom_m, b.bottom_m));
  EXPECT_TRUE(same_number(a.top_m, b.top_m));
}

inline void expect_same_intrinsics(const host::Intrinsics& a, const host::Intrinsics& b) {
  ASSERT_EQ(a.index(), b.index());
  if (const auto* encoder = std::get_if<host::EncoderIntrinsics>(&a)) {
    const auto& wheels = std::get<host::EncoderIntrinsics>(b).wheels;
    ASSERT_EQ(encoder->wheels.size(), wheels.size());
    for (std::size_t i = 0; i < wheels.size(); ++i)
      EXPECT_EQ(std::memcmp(&encoder->wheels[i], &wheels[i], sizeof wheels[i]), 0) << i;
  }
  if (const auto* bump = std::get_if<host::BumpIntrinsics>(&a)) {
    const auto& zones = std::get<host::BumpIntrinsics>(b).zones;
    ASSERT_EQ(bump->zones.size(), zones.size());
    for (std::size_t i = 0; i < zones.size(); ++i) {
      const host::BumpZoneInfo &p = bump->zones[i], &q = zones[i];
      EXPECT_EQ(p.name, q.name);
      EXPECT_TRUE(same_number(p.middle_rad, q.middle_rad) && same_number(p.width_rad, q.width_rad)) << i;
      EXPECT_TRUE(same_number(p.bottom_m, q.bottom_m) && same_number(p.top_m, q.top_m)) << i;
    }
  }
  if (const auto* scan = std::get_if<host::RangeScanIntrinsics>(&a)) {
    const auto& other = std::get<host::RangeScanIntrinsics>(b);
    EXPECT_EQ(scan->width, other.width);
    EXPECT_EQ(scan->height, other.height);
    EXPECT_EQ(scan->layers, other.layers);
    EXPECT_TRUE(same_number(scan->beam_rad, other.beam_rad) && same_number(scan->scan_s, other.scan_s));
  }
  if (const auto* imu = std::get_if<host::ImuIntrinsics>(&a)) {
    for (const host::ImuNumber& number : host::imu_numbers())
      EXPECT_TRUE(same_number(imu->*number.host, std::get<host::ImuIntrinsics>(b).*number.host))
          << number.key;
  }
  if (const auto* gnss = std::get_if<host::GnssIntrinsics>(&a)) {
    const auto& other = std::get<host::GnssIntrinsics>(b);
    EXPECT_TRUE(same_number(gnss->latitude_deg, other.latitude_deg));
    EXPECT_TRUE(same_number(gnss->longitude_deg, other.longitude_deg));
    EXPECT_TRUE(same_number(gnss->altitude_m, other.altitude_m));
  }
}

inline void expect_same_pace(const host::SensorInfo& a, const host::SensorInfo& b) {
  EXPECT_TRUE(same_number(a.rate_hz, b.rate_hz)) << a.name;
  EXPECT_TRUE(same_number(a.latency_s, b.latency_s)) << a.name;
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_TRUE(same_number(a.noise_per_m[axis], b.noise_per_m[axis])) << a.name << axis;
}

inline void expect_same_sensor(const host::SensorInfo& a, const host::SensorInfo& b) {
  expect_same_pace(a, b);
  expect_same_intrinsics(a.intrinsics, b.intrinsics);
}

/// Expects the same drive and body, and of each sensor the same rate, latency, growth of noise and intrinsics.
inline void expect_same_robot(const host::Activation& a, const host::Activation& b) {
  ASSERT_EQ(a.drive.has_value(), b.drive.has_value());
  ASSERT_EQ(a.body.has_value(), b.body.has_value());
  if (a.drive) expect_same_drive(*a.drive, *b.drive);
  if (a.body) expect_same_body(*a.body, *b.body);
  ASSERT_EQ(a.sensors.size(), b.sensors.size());
  for (std::size_t i = 0; i < a.sensors.size(); ++i) expect_same_sensor(a.sensors[i], b.sensors[i]);
}

}  // namespace hallway::test
