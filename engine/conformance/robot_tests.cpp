// SPDX-License-Identifier: MIT
// What an activation says of the robot: drive, body, intrinsics of sensors.
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "conformance/instance.hpp"
#include "conformance/ordinary_robot.hpp"
#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// Activates a new plugin for a robot, and gives it two frames.
void work_on(const Subject& subject, const RobotFacts& robot, const InputShape& shape = {}) {
  Instance plugin(subject);
  plugin.activate(plugin.ordinary().sensors(), shape, robot).demand_good();
  for (std::uint64_t step = 0; step < 2; ++step) plugin.step(step).demand_valid();
}

/// The same with other facts of its sensors.
template <typename Change>
void change_sensors(const Subject& subject, Change change) {
  Instance plugin(subject);
  std::vector<hw_sensor_info_t> sensors = plugin.ordinary().sensors();
  for (hw_sensor_info_t& sensor : sensors) change(sensor);
  plugin.activate(sensors).demand_good();
  for (std::uint64_t step = 0; step < 2; ++step) plugin.step(step).demand_valid();
}

hw_drive_info_t unknown_drive() {
  hw_drive_info_t drive{};
  drive.size = sizeof drive;
  drive.kind = HW_DRIVE_UNKNOWN;
  for (double hw_drive_info_t::*number :
       {&hw_drive_info_t::max_speed_m_s, &hw_drive_info_t::max_lateral_m_s,
        &hw_drive_info_t::max_angular_rad_s, &hw_drive_info_t::max_acceleration_m_s2,
        &hw_drive_info_t::max_deceleration_m_s2, &hw_drive_info_t::max_angular_acceleration_rad_s2,
        &hw_drive_info_t::greatest_steering_rad, &hw_drive_info_t::max_steering_rate_rad_s,
        &hw_drive_info_t::wheel_base_m, &hw_drive_info_t::axle_distance_m, &hw_drive_info_t::wheel_radius_m,
        &hw_drive_info_t::latency_s, &hw_drive_info_t::dead_band_m_s, &hw_drive_info_t::dead_band_rad_s})
    drive.*number = kNotKnown;
  return drive;
}

hw_body_info_t round_body(double radius_m, double top_m) {
  hw_body_info_t body{};
  body.size = sizeof body;
  body.radius_m = radius_m;
  body.bottom_m = top_m - 0.3;
  body.top_m = top_m;
  return body;
}

void takes_an_unknown_robot(const Subject& subject) {
  work_on(subject, {});
  work_on(subject, {.drive = unknown_drive(), .body = round_body(kNotKnown, kNotKnown)});
}

void takes_any_drive(const Subject& subject) {
  for (const std::uint32_t kind :
       {HW_DRIVE_TRACKED + 0u, HW_DRIVE_ACKERMANN + 0u, HW_DRIVE_OMNIDIRECTIONAL + 0u, 4711u, UINT32_MAX}) {
    RobotFacts robot = ordinary_robot();
    robot.drive->kind = kind;
    work_on(subject, robot);
  }
  RobotFacts slow = ordinary_robot();
  slow.drive->max_speed_m_s = slow.drive->max_angular_rad_s = 0.0;
  work_on(subject, slow);
}

void takes_any_body(const Subject& subject) {
  std::vector<double> corners;
  for (int i = 0; i < 200; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 200;
    corners.insert(corners.end(), {std::cos(angle), std::sin(angle)});
  }
  RobotFacts robot = ordinary_robot();
  robot.body->n_corners = 200;
  robot.body->corners = corners.data();
  robot.body->radius_m = 1.0;
  work_on(subject, robot, {.tight = true});
  robot.body->n_corners = 3;
  constexpr double kTriangle[] = {1.0, 0.0, 0.0, 0.5, -0.5, -0.5};
  robot.body->corners = kTriangle;
  work_on(subject, robot, {.tight = true});
  robot.body = round_body(0.25, 1.8);
  work_on(subject, robot, {.tight = true});
}

void takes_unknown_intrinsics(const Subject& subject) {
  change_sensors(subject, [](hw_sensor_info_t& sensor) { sensor.intrinsics = nullptr; });
  const hw_bump_zone_info_t zone{"", kNotKnown, kNotKnown, kNotKnown, kNotKnown};
  const hw_encoder_wheel_t wheel{
      kNotKnown, {kNotKnown, kNotKnown, kNotKnown}, {kNotKnown, kNotKnown, kNotKnown}};
  const std::vector<hw_bump_zone_info_t> zones(kWalkElements, zone);
  const std::vector<hw_encoder_wheel_t> wheels(kWalkElements, wheel);
  for (const std::uint64_t count : {std::uint64_t{0}, std::uint64_t{kWalkElements}}) {
    const hw_bump_info_t bump{sizeof bump, sizeof zone, count, zones.data()};
    const hw_encoder_info_t encoder{sizeof encoder, sizeof wheel, count, wheels.data()};
    const hw_range_scan_info_t scan{sizeof scan, 0, 0, 0, kNotKnown, kNotKnown};
    const hw_imu_info_t imu{sizeof imu, 0,         kNotKnown, kNotKnown, kNotKnown,
                            kNotKnown,  kNotKnown, kNotKnown, kNotKnown};
    const hw_gnss_info_t gnss{sizeof gnss, 0, kNotKnown, kNotKnown, kNotKnown};
    change_sensors(subject, [&](hw_sensor_info_t& sensor) {
      sensor.intrinsics = &sensor;  // of a kind that has none yet: any struct that begins with its size
      if (sensor.kind == HW_SAMPLE_BUMP) sensor.intrinsics = &bump;
      if (sensor.kind == HW_SAMPLE_ENCODER) sensor.intrinsics = &encoder;
      if (sensor.kind == HW_SAMPLE_RANGE_SCAN) sensor.intrinsics = &scan;
      if (sensor.kind == HW_SAMPLE_IMU) sensor.intrinsics = &imu;
      if (sensor.kind == HW_SAMPLE_GNSS) sensor.intrinsics = &gnss;
    });
  }
}

void takes_any_rate(const Subject& subject) {
  for (const double number : {kNotKnown, 0.0, 1e-3, 1e6}) {
    change_sensors(subject, [&](hw_sensor_info_t& sensor) {
      sensor.rate_hz = sensor.latency_s = number;
      for (double& noise : sensor.noise_per_m) noise = number;
    });
  }
}

/// Nothing is behind what an older version had: it is not there, or memory that nobody may touch.
void works_on_an_older_host(const Subject& subject) {
  for (const std::uint32_t minor : {0u, 4u}) {
    work_on(subject, {}, {.minor = minor});
    work_on(subject, {}, {.minor = minor, .tight = true});
  }
}

constexpr Test kRobotTests[] = {
    {"activate-unknown-robot", "A drive or body of which nothing is known is no reason to fail.",
     takes_an_unknown_robot},
    {"activate-any-drive", "A robot may have any drive, also one of a kind that the plugin does not know.",
     takes_any_drive},
    {"activate-any-body", "A robot may have any body, round or with corners.", takes_any_body},
    {"activate-unknown-intrinsics",
     "Intrinsics of a sensor that nothing is known of, or that the plugin does not know, are no reason to "
     "fail.",
     takes_unknown_intrinsics},
    {"activate-any-rate", "A sensor may have any rate, latency and growth of noise, or none that is known.",
     takes_any_rate},
    {"older-activation",
     "Members that hw_activation_t and hw_sensor_info_t did not have in older versions are not read where "
     "they are not there.",
     works_on_an_older_host},
};

}  // namespace

std::span<const Test> robot_tests() {
  return kRobotTests;
}

}  // namespace hallway::conformance
