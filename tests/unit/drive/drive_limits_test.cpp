// SPDX-License-Identifier: MIT
// No limit is exceeded at any time, whatever is commanded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drive/drive.hpp"
#include "unit/drive/drives.hpp"

namespace hallway::drive {
namespace {

using testing::Dice;
using testing::kSecond;

constexpr double kMore = 1.0 + 1e-9;

void expect_within(const DriveSpec& spec, const Motion& motion) {
  const double turned = 1.0 - spec.turn_slip;
  for (const PlanarTwist& twist : {motion.body.from, motion.body.to}) {
    ASSERT_LE(std::abs(twist.forward_m_s), spec.max_speed_m_s * kMore);
    ASSERT_LE(std::abs(twist.lateral_m_s), lateral_limit(spec) * kMore + 1e-12);
    if (spec.kind == DriveKind::kAckermann) {
      ASSERT_LE(std::abs(twist.angular_rad_s) * spec.axle_distance_m,
                std::abs(twist.forward_m_s) * std::tan(spec.greatest_steering_rad) * kMore + 1e-12);
    } else {
      ASSERT_LE(std::abs(twist.angular_rad_s), spec.max_angular_rad_s * turned * kMore);
    }
  }
  if (spec.kind == DriveKind::kAckermann) return;
  for (const PerWheel& speeds : {motion.wheels.from, motion.wheels.to}) {
    for (const double speed : speeds) ASSERT_LE(std::abs(speed), spec.max_speed_m_s * kMore);
  }
}

/// The change of a part over a piece. One that goes by way of 0 within a piece keeps both rates.
void expect_rate(double from, double to, double growing, double shrinking, double time) {
  const bool grows = std::abs(to) > std::abs(from);
  const bool crosses = from * to < 0.0 && std::min(std::abs(from), std::abs(to)) > 1e-12;  // but for rounding
  const double rate = crosses ? std::min(growing, shrinking) : (grows ? growing : shrinking);
  ASSERT_LE(std::abs(to - from), rate * time * 1.000001 + 1e-12) << from << " " << to;
}

void expect_accelerations(const DriveSpec& spec, const TwistRamp& body) {
  const double time = seconds(body.duration_ns);
  const double up = spec.max_acceleration_m_s2;
  const double down = deceleration_limit(spec);
  expect_rate(body.from.forward_m_s, body.to.forward_m_s, up, down, time);
  expect_rate(body.from.lateral_m_s, body.to.lateral_m_s, up, down, time);
  if (spec.kind == DriveKind::kAckermann) return;
  const double turn = spec.max_angular_acceleration_rad_s2;
  expect_rate(body.from.angular_rad_s, body.to.angular_rad_s, turn, turn, time);
}

TEST(DriveLimits, HoldForRandomSpecsAndCommands) {
  Dice dice(41);
  for (int i = 0; i < 1000; ++i) {
    const DriveSpec spec = testing::random_spec(dice);
    Drive drive(spec, 1);
    PlanarTwist last{};
    for (std::int64_t t = 0; t < 6 * kSecond; t += dice.whole(1, kSecond)) {
      for (const Motion& motion : drive.advance(t)) {
        expect_within(spec, motion);
        expect_accelerations(spec, motion.body);
        ASSERT_NEAR(motion.body.from.forward_m_s, last.forward_m_s, 1e-12);  // no step between pieces
        ASSERT_NEAR(motion.body.from.lateral_m_s, last.lateral_m_s, 1e-12);
        ASSERT_NEAR(motion.body.from.angular_rad_s, last.angular_rad_s, 1e-11);
        last = motion.body.to;
        if (HasFatalFailure()) return;
      }
      drive.command(t, testing::random_command(dice));
    }
  }
}

TEST(DriveLimits, SteeringKeepsAngleAndRate) {
  Dice dice(42);
  for (int i = 0; i < 100; ++i) {
    DriveSpec spec = testing::random_spec(dice);
    spec = {.kind = DriveKind::kAckermann,
            .greatest_steering_rad = spec.greatest_steering_rad,
            .max_steering_rate_rad_s = spec.max_steering_rate_rad_s};
    Drive drive(spec, 1);
    double last = 0.0;
    for (int step = 1; step <= 300; ++step) {
      if (step % 20 == 1) drive.command(drive.present_ns(), testing::random_command(dice));
      drive.advance(step * kSecond / 50);
      EXPECT_LE(std::abs(drive.steering_rad()), spec.greatest_steering_rad);
      EXPECT_LE(std::abs(drive.steering_rad() - last), spec.max_steering_rate_rad_s * 0.02 * kMore + 1e-12);
      last = drive.steering_rad();
    }
  }
}

TEST(DriveLimits, HugeCommandsAreDriven) {
  for (const DriveKind kind : testing::kKinds) {
    Drive drive({.kind = kind}, 1);
    const Obeyed obeyed = drive.command(0, {1e300, -1e300, 1e300});
    EXPECT_TRUE(obeyed.clamps.speed);
    EXPECT_TRUE(obeyed.clamps.angular || obeyed.clamps.steering);
    EXPECT_EQ(obeyed.clamps.left_out, kind != DriveKind::kOmnidirectional);
    drive.advance(20 * kSecond);
    EXPECT_NEAR(drive.twist().forward_m_s, obeyed.command.forward_m_s, 1e-15);
    EXPECT_NEAR(drive.twist().lateral_m_s, obeyed.command.lateral_m_s, 1e-15);
    EXPECT_NEAR(drive.twist().angular_rad_s, obeyed.command.angular_rad_s, 1e-14);
    EXPECT_GT(drive.twist().forward_m_s, 0.1);
  }
}

/// Straight to a turn on the spot: each part at its own rate would make the outer wheel too fast.
TEST(DriveLimits, PartsGoInStepWhereAWheelWouldBeTooFast) {
  const DriveSpec spec{.wheel_base_m = 0.3,
                       .max_speed_m_s = 0.6,
                       .max_angular_rad_s = 4.0,
                       .max_acceleration_m_s2 = 0.5,
                       .max_angular_acceleration_rad_s2 = 8.0};
  Drive drive(spec, 1);
  drive.command(0, {0.6, 0.0, 0.0});
  drive.advance(2 * kSecond);
  drive.command(2 * kSecond, {0.0, 0.0, 4.0});
  drive.advance(2 * kSecond + 600'000'000);  // half of 0.6 / 0.5 s
  EXPECT_NEAR(drive.twist().forward_m_s, 0.3, 1e-12);
  EXPECT_NEAR(drive.twist().angular_rad_s, 2.0, 1e-12);
}

}  // namespace
}  // namespace hallway::drive
