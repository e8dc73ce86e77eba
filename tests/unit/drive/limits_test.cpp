// SPDX-License-Identifier: MIT
#include "drive/limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/drive/drives.hpp"

namespace hallway::drive {
namespace {

TEST(Limits, CommandWithinThemIsUnchanged) {
  const LimitedCommand limited = limit({}, {0.3, 0.0, -0.5});
  EXPECT_EQ(limited.command, (Command{0.3, 0.0, -0.5}));
  EXPECT_EQ(limited.clamps, Clamps{});
}

TEST(Limits, PartsAreClampedAndReported) {
  const LimitedCommand fast = limit({}, {-5.0, 0.0, 0.0});
  EXPECT_EQ(fast.command, (Command{-0.6, 0.0, 0.0}));
  EXPECT_EQ(fast.clamps, (Clamps{.speed = true}));
  const LimitedCommand turn = limit({}, {0.0, 0.0, 5.0});
  EXPECT_EQ(turn.command, (Command{0.0, 0.0, 2.0}));
  EXPECT_EQ(turn.clamps, (Clamps{.angular = true}));
}

TEST(Limits, WheelLimitKeepsTheCurvature) {
  const LimitedCommand limited = limit({}, {0.6, 0.0, 1.0});
  EXPECT_NEAR(limited.command.forward_m_s + 0.15 * limited.command.angular_rad_s, 0.6, 1e-15);
  EXPECT_NEAR(limited.command.angular_rad_s / limited.command.forward_m_s, 1.0 / 0.6, 1e-15);
  EXPECT_EQ(limited.clamps, (Clamps{.speed = true, .angular = true}));
}

TEST(Limits, HugeCommandsDoNotOverflow) {
  testing::Dice dice(1);
  for (int i = 0; i < 1000; ++i) {
    const DriveSpec spec = testing::random_spec(dice);
    const auto huge = [&] {
      return std::copysign(std::pow(10.0, dice.within(-300.0, 308.0)), dice.within(-1.0, 1.0));
    };
    for (const Command& command :
         {Command{huge(), huge(), huge()}, Command{1e300, 1e300, -1e300}, Command{1e-300, 0.0, 1e300}}) {
      const LimitedCommand limited = limit(spec, command);
      EXPECT_LE(std::abs(limited.command.forward_m_s), spec.max_speed_m_s);
      EXPECT_LE(std::abs(limited.command.lateral_m_s), lateral_limit(spec));
      EXPECT_LE(std::abs(limited.command.angular_rad_s), spec.max_angular_rad_s * (1.0 + 1e-12));
      EXPECT_LE(std::abs(limited.steering_rad.value_or(0.0)), spec.greatest_steering_rad);
      EXPECT_TRUE(wheels_are_within(spec, limited.command));
    }
  }
}

TEST(Limits, DeadBandIsOfEachPart) {
  const DriveSpec spec{.dead_band_m_s = 0.05, .dead_band_rad_s = 0.1};
  EXPECT_EQ(limit(spec, {0.049, 0.0, 0.1}).command, (Command{0.0, 0.0, 0.1}));
  EXPECT_EQ(limit(spec, {0.049, 0.0, 0.1}).clamps, (Clamps{.dead_band = true}));
  EXPECT_EQ(limit(spec, {-0.05, 0.0, -0.099}).command, (Command{-0.05, 0.0, 0.0}));
  EXPECT_EQ(limit(spec, {}).clamps, Clamps{});
}

TEST(Limits, SidewaysIsLeftOutOnWheels) {
  EXPECT_EQ(limit({}, {0.1, 0.2, 0.0}).command, (Command{0.1, 0.0, 0.0}));
  EXPECT_EQ(limit({}, {0.1, 0.2, 0.0}).clamps, (Clamps{.left_out = true}));
  const DriveSpec omni{.kind = DriveKind::kOmnidirectional, .max_lateral_m_s = 0.3};
  EXPECT_EQ(limit(omni, {0.1, 0.2, 0.0}).command, (Command{0.1, 0.2, 0.0}));
  EXPECT_EQ(limit(omni, {0.0, -0.4, 0.0}).command, (Command{0.0, -0.3, 0.0}));
  EXPECT_EQ(limit(omni, {0.0, -0.4, 0.0}).clamps, (Clamps{.lateral = true}));
}

TEST(Limits, CarTurnsByItsSteering) {
  const DriveSpec car{.kind = DriveKind::kAckermann, .axle_distance_m = 0.5, .greatest_steering_rad = 0.5};
  const LimitedCommand gentle = limit(car, {0.5, 0.0, 0.3});
  EXPECT_DOUBLE_EQ(*gentle.steering_rad, std::atan(0.3));
  EXPECT_EQ(gentle.clamps, Clamps{});
  const LimitedCommand back = limit(car, {-0.5, 0.0, 0.3});
  EXPECT_DOUBLE_EQ(*back.steering_rad, -std::atan(0.3));
  const LimitedCommand sharp = limit(car, {0.5, 0.0, -1.5});
  EXPECT_EQ(*sharp.steering_rad, -0.5);
  EXPECT_DOUBLE_EQ(sharp.command.angular_rad_s, -std::tan(0.5));
  EXPECT_EQ(sharp.clamps, (Clamps{.steering = true}));
}

TEST(Limits, StandingCarDoesNotTurn) {
  const LimitedCommand limited = limit({.kind = DriveKind::kAckermann}, {0.0, 0.0, 0.5});
  EXPECT_EQ(limited.command, Command{});
  EXPECT_FALSE(limited.steering_rad);
  EXPECT_EQ(limited.clamps, (Clamps{.left_out = true}));
  EXPECT_EQ(limit({.kind = DriveKind::kAckermann}, {}).clamps, Clamps{});
}

}  // namespace
}  // namespace hallway::drive
