// SPDX-License-Identifier: MIT
// What a host knows of drive, body and intrinsics, through the ABI, in this process and in one of its own.
#include "host/robot_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>

#include "fixtures.hpp"
#include "host/c_activation.hpp"
#include "host/isolate/isolated_plugin.hpp"
#include "host/plugin.hpp"
#include "host/samples/point_kind.hpp"
#include "support/errors.hpp"
#include "support/known_robot.hpp"

namespace hallway::host {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string refusal_of(const std::function<void()>& work) {
  const auto error = test::error_of(work);
  return error ? error->message() : "";
}

Activation read_back(const hw_activation_t& c) {
  Activation back;
  for (std::uint32_t i = 0; i < c.n_sensors; ++i) {
    SensorInfo& sensor = back.sensors.emplace_back();
    sensor.kind = c.sensors[i]->kind;
    sensor.name = c.sensors[i]->name;
    take_later_facts(*c.sensors[i], sensor);
  }
  if (c.drive != nullptr) back.drive = drive_of(*c.drive);
  if (c.body != nullptr) back.body = body_of(*c.body);
  return back;
}

TEST(RobotParts, AreTheSameOnTheOtherSideOfTheAbi) {
  const CActivation whole(test::known_robot());
  test::expect_same_robot(read_back(whole.get()), test::known_robot());
  Activation unknown;
  unknown.drive.emplace();
  unknown.body.emplace();
  test::expect_same_robot(read_back(CActivation(unknown).get()), unknown);
}

TEST(RobotParts, WhatIsNotKnownIsNull) {
  const CActivation facts(Activation{std::vector<SensorInfo>{point_sensor("eyes")}});
  EXPECT_EQ(facts.get().drive, nullptr);
  EXPECT_EQ(facts.get().body, nullptr);
  EXPECT_EQ(facts.get().sensors[0]->intrinsics, nullptr);
  EXPECT_TRUE(std::isnan(facts.get().sensors[0]->rate_hz));
}

TEST(RobotParts, WhatAnOlderSensorDoesNotHaveIsNotKnown) {
  const CActivation facts(test::known_robot());
  hw_sensor_info_t sensor = *facts.get().sensors[3];
  sensor.size = offsetof(hw_sensor_info_t, rate_hz);
  EXPECT_TRUE(std::isnan(hw_rate_hz_of(&sensor)));
  EXPECT_TRUE(std::isnan(hw_latency_s_of(&sensor)));
  EXPECT_TRUE(std::isnan(hw_noise_per_m_of(&sensor, 2)));
  ASSERT_NE(hw_range_scan_info_of(&sensor), nullptr);
  EXPECT_EQ(hw_range_scan_info_of(&sensor)->width, 1800u);
  EXPECT_EQ(hw_imu_info_of(&sensor), nullptr) << "it is none";
  sensor.size = offsetof(hw_sensor_info_t, intrinsics);
  EXPECT_EQ(hw_range_scan_info_of(&sensor), nullptr);
}

TEST(RobotParts, RatesWithoutSenseAreNamed) {
  for (const double value : {-0.1, kInfinity, -kInfinity}) {
    SensorInfo sensor = point_sensor("eyes");
    sensor.rate_hz = value;
    EXPECT_EQ(problem_of(sensor), "a rate below 0 or not finite");
    sensor = point_sensor("eyes");
    sensor.latency_s = value;
    EXPECT_EQ(problem_of(sensor), "a latency below 0 or not finite");
    sensor = point_sensor("eyes");
    sensor.noise_per_m[1] = value;
    EXPECT_EQ(problem_of(sensor), "noise per metre below 0 or not finite");
    const CActivation facts(Activation{std::vector<SensorInfo>{sensor}});
    SensorInfo back;
    EXPECT_EQ(refusal_of([&] { take_later_facts(*facts.get().sensors[0], back); }),
              "noise per metre below 0 or not finite");
  }
}

TEST(RobotParts, TheRadiusOfAPolygonIsThatOfItsFarthestCorner) {
  Activation robot = test::known_robot();
  robot.body->corners.push_back({0.05, -0.25});
  robot.body->radius_m = DriveInfo::kUnknown;
  const CActivation facts(robot);
  EXPECT_DOUBLE_EQ(facts.get().body->radius_m, std::hypot(0.3, 0.2));
  robot.body->corners.clear();
  robot.body->radius_m = 0.4;
  EXPECT_EQ(CActivation(robot).get().body->radius_m, 0.4);
  EXPECT_EQ(CActivation(robot).get().body->corners, nullptr);
}

TEST(RobotParts, AnUnknownKindOfDriveIsTakenForUnknown) {
  const CActivation facts(test::known_robot());
  hw_drive_info_t drive = *facts.get().drive;
  drive.kind = 4711;
  EXPECT_EQ(drive_of(drive).kind, std::uint32_t{HW_DRIVE_UNKNOWN});
  EXPECT_EQ(drive_of(drive).max_speed_m_s, drive.max_speed_m_s);
}

TEST(RobotParts, StructsOfAWrongSizeAreRefused) {
  const CActivation facts(test::known_robot());
  hw_drive_info_t drive = *facts.get().drive;
  drive.size -= 8;
  EXPECT_EQ(refusal_of([&] { drive_of(drive); }), "a drive of a wrong size");
  hw_body_info_t body = *facts.get().body;
  body.size -= 8;
  EXPECT_EQ(refusal_of([&] { body_of(body); }), "a body of a wrong size");
  for (const std::uint32_t i : {0u, 1u, 3u, 4u}) {
    hw_sensor_info_t sensor = *facts.get().sensors[i];
    const std::uint32_t small[] = {16, 0};
    sensor.intrinsics = small;
    SensorInfo info{.kind = sensor.kind, .name = {}};
    EXPECT_EQ(refusal_of([&] { take_later_facts(sensor, info); }), "intrinsics of a wrong size");
    sensor.size = offsetof(hw_sensor_info_t, intrinsics);
    EXPECT_EQ(refusal_of([&] { take_later_facts(sensor, info); }), "")
        << "it was written before there were any";
  }
}

TEST(RobotParts, ListsWithoutSenseAreRefused) {
  const CActivation facts(test::known_robot());
  hw_encoder_info_t encoder = *hw_encoder_info_of(facts.get().sensors[0]);
  hw_sensor_info_t sensor = *facts.get().sensors[0];
  sensor.intrinsics = &encoder;
  SensorInfo info{.kind = sensor.kind, .name = {}};
  const auto refusal = [&] { return refusal_of([&] { take_later_facts(sensor, info); }); };
  EXPECT_EQ(refusal(), "");
  encoder.stride = 48;
  EXPECT_EQ(refusal(), "intrinsics with a wrong stride");
  encoder.stride = sizeof(hw_encoder_wheel_t);
  encoder.count = UINT64_MAX;
  EXPECT_EQ(refusal(), "intrinsics of more than 256 parts");
  encoder.count = 1;
  encoder.wheels = nullptr;
  EXPECT_EQ(refusal(), "intrinsics whose list is null");
}

TEST(RobotParts, DrivesWithoutSenseAreNamed) {
  for (const DriveNumber& number : drive_numbers()) {
    for (const double value : {-0.1, kInfinity, -kInfinity}) {
      DriveInfo drive;
      drive.*number.host = value;
      EXPECT_NE(problem_of(drive).find(number.key), std::string::npos) << value;
    }
    DriveInfo drive;
    for (const double value : {0.0, 1e300, DriveInfo::kUnknown}) {
      drive.*number.host = value;
      EXPECT_EQ(problem_of(drive), "") << number.key;
    }
  }
}

TEST(RobotParts, BodiesWithoutSenseAreNamed) {
  const auto problem = [](std::vector<std::array<double, 2>> corners) {
    return problem_of(BodyInfo{.corners = std::move(corners)});
  };
  EXPECT_EQ(problem({{0, 0}, {1, 0}, {0, 1}}), "");
  EXPECT_NE(problem({{0, 0}, {0, 1}, {1, 0}}), "") << "clockwise";
  EXPECT_NE(problem({{0, 0}, {1, 0}}), "");
  EXPECT_NE(problem({{0, 0}, {2, 0}, {1, 0.5}, {1, 2}}), "") << "a corner turns to the right";
  EXPECT_NE(problem({{0, 0}, {1, 0}, {2, 0}, {1, 1}}), "") << "a corner does not turn";
  EXPECT_NE(problem({{0, 0}, {1, 0}, {kInfinity, 1}}), "");
  std::vector<std::array<double, 2>> star;  // each corner turns to the left, twice around
  for (int i = 0; i < 5; ++i) {
    const double angle = 2.0 * std::numbers::pi * 2 * i / 5;
    star.push_back({std::cos(angle), std::sin(angle)});
  }
  EXPECT_NE(problem(star), "");
  EXPECT_NE(problem_of(BodyInfo{.radius_m = -1.0}), "");
  EXPECT_NE(problem_of(BodyInfo{.bottom_m = 1.0, .top_m = 0.5}), "");
  EXPECT_NE(problem_of(BodyInfo{.top_m = kInfinity}), "");
  EXPECT_EQ(problem_of(BodyInfo{}), "");
}

TEST(RobotParts, IntrinsicsWithoutSenseAreNamed) {
  const auto problem = [](std::uint32_t kind, Intrinsics intrinsics) {
    return problem_of_intrinsics({.kind = kind, .name = {}, .intrinsics = std::move(intrinsics)});
  };
  const auto wheel = [&](const EncoderWheel& of) {
    return problem(HW_SAMPLE_ENCODER, EncoderIntrinsics{{of}});
  };
  EXPECT_EQ(wheel({}), "");
  EXPECT_NE(wheel({.m_per_tick = 0.0}), "");
  EXPECT_NE(wheel({.m_per_tick = kInfinity}), "");
  EXPECT_NE(wheel({.position = {0.0, kInfinity, 0.0}}), "");
  EXPECT_NE(wheel({.direction = {0.5, 0.0, 0.0}}), "");
  const auto zone = [&](const BumpZoneInfo& of) { return problem(HW_SAMPLE_BUMP, BumpIntrinsics{{of}}); };
  EXPECT_EQ(zone({}), "");
  EXPECT_EQ(zone({.middle_rad = 40.0, .width_rad = 2.0 * std::numbers::pi}), "");
  EXPECT_NE(zone({.middle_rad = kInfinity}), "");
  EXPECT_NE(zone({.width_rad = 0.0}), "");
  EXPECT_NE(zone({.width_rad = 6.3}), "");
  EXPECT_NE(zone({.bottom_m = 1.0, .top_m = 0.0}), "");
  const auto scan = [&](const RangeScanIntrinsics& of) { return problem(HW_SAMPLE_RANGE_SCAN, of); };
  EXPECT_EQ(scan({}), "");
  EXPECT_EQ(scan({.width = 1, .height = 1, .beam_rad = 0.0, .scan_s = 0.0}), "");
  EXPECT_NE(scan({.width = 1}), "");
  EXPECT_NE(scan({.beam_rad = -0.1}), "");
  EXPECT_NE(scan({.scan_s = kInfinity}), "");
  for (const ImuNumber& number : imu_numbers()) {
    for (const double value : {-0.1, kInfinity}) {
      ImuIntrinsics imu;
      imu.*number.host = value;
      EXPECT_NE(problem(HW_SAMPLE_IMU, imu).find(number.key), std::string::npos) << value;
    }
  }
  EXPECT_EQ(problem(HW_SAMPLE_IMU, ImuIntrinsics{}), "");
  EXPECT_NE(problem(HW_SAMPLE_POINTS, ImuIntrinsics{}), "");
  EXPECT_NE(problem(HW_SAMPLE_IMU, RangeScanIntrinsics{}), "");
  EXPECT_NE(problem(HW_SAMPLE_POINTS, EncoderIntrinsics{}), "");
  EXPECT_NE(problem(HW_SAMPLE_ENCODER, BumpIntrinsics{}), "");
}

/// What the fixture tells of a robot.
std::map<std::string, double> told(Stage& plugin, const Activation& robot) {
  plugin.activate(robot);
  FrameBuilder builder;
  builder.begin(0, 0);
  add_points(builder, 9);
  std::map<std::string, double> counters;
  for (const Counter& counter : plugin.process(builder.finish()).counters())
    counters[counter.name] = counter.value;
  return counters;
}

TEST(RobotParts, APluginIsToldTheSameInAProcessOfItsOwn) {
  const std::string file = FIXTURES "/reads_robot.so";
  Activation unknown = test::known_robot();
  unknown.drive.reset();
  unknown.body.emplace();
  for (const Activation& robot : {test::known_robot(), unknown}) {
    Plugin here(find_plugin(file, {}));
    IsolatedPlugin there(file, {}, {}, {});
    const auto expected = told(here, robot);
    EXPECT_EQ(told(there, robot), expected);
    EXPECT_EQ(expected.contains("drive_0"), robot.drive.has_value());
    EXPECT_EQ(expected.contains("corner_9"), !robot.body->corners.empty());
    EXPECT_EQ(expected.at("wheel_4_0"), 1.0 / 3.0);
    EXPECT_EQ(expected.at("wheel_4_12"), 0.8);
    EXPECT_EQ(expected.at("zone_7_5"), 12.0) << "letters of its name";
    EXPECT_FALSE(expected.contains("zone_7_8")) << "it is not known";
    EXPECT_EQ(expected.at("scan_12_0"), 1800.0);
    EXPECT_EQ(expected.at("scan_12_4"), 1.0 / 9.0);
    EXPECT_EQ(expected.at("imu_13_6"), std::get<ImuIntrinsics>(robot.sensors[4].intrinsics).max_force_m_s2);
    EXPECT_EQ(expected.at("pace_7_0"), 250.0);
    EXPECT_EQ(expected.at("pace_9_3"), 0.002);
    EXPECT_EQ(expected.at("pace_13_0"), 0.0);
    EXPECT_FALSE(expected.contains("pace_4_0")) << "it is not known";
    if (!robot.drive) continue;
    EXPECT_EQ(expected.at("drive_0"), HW_DRIVE_OMNIDIRECTIONAL);
    EXPECT_EQ(expected.at("drive_14"), robot.drive->dead_band_rad_s);
    EXPECT_EQ(expected.at("corner_9"), -0.25);
  }
}

}  // namespace
}  // namespace hallway::host
