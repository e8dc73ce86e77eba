// SPDX-License-Identifier: MIT
#include "drive/wheels.hpp"

#include <gtest/gtest.h>

#include "unit/drive/drives.hpp"

namespace hallway::drive {
namespace {

using testing::kSecond;

TEST(Wheels, TwoWheelsShareATurn) {
  const DriveSpec spec{.wheel_base_m = 0.4};
  EXPECT_EQ(wheel_speeds(spec, {0.5, 0.0, 0.0}), (PerWheel{0.5, 0.5, 0.0, 0.0}));
  const PerWheel turn = wheel_speeds(spec, {0.0, 0.0, 1.0});
  EXPECT_DOUBLE_EQ(turn[0], -0.2);
  EXPECT_DOUBLE_EQ(turn[1], 0.2);
}

TEST(Wheels, MecanumWheelsCrossForSideways) {
  const DriveSpec spec{.kind = DriveKind::kOmnidirectional, .wheel_base_m = 0.4, .axle_distance_m = 0.6};
  EXPECT_EQ(wheel_speeds(spec, {0.0, 0.3, 0.0}), (PerWheel{-0.3, 0.3, 0.3, -0.3}));
  const PerWheel turn = wheel_speeds(spec, {0.0, 0.0, 2.0});
  EXPECT_DOUBLE_EQ(turn[0], -1.0);
  EXPECT_DOUBLE_EQ(turn[3], 1.0);
}

TEST(Wheels, TwistOfSpeedsIsTheInverse) {
  testing::Dice dice(8);
  for (int i = 0; i < 200; ++i) {
    const DriveSpec spec = testing::random_spec(dice);
    PlanarTwist twist = testing::random_command(dice);
    if (spec.kind != DriveKind::kOmnidirectional) twist.lateral_m_s = 0.0;
    const PlanarTwist back = twist_of(spec, wheel_speeds(spec, twist));
    EXPECT_NEAR(back.forward_m_s, twist.forward_m_s, 1e-14);
    EXPECT_NEAR(back.lateral_m_s, twist.lateral_m_s, 1e-14);
    EXPECT_NEAR(back.angular_rad_s, twist.angular_rad_s, 1e-13);
  }
}

TEST(Wheels, NamesMatchTheCount) {
  EXPECT_EQ(wheel_count(DriveKind::kAckermann), 2u);
  EXPECT_EQ(wheel_count(DriveKind::kOmnidirectional), 4u);
  EXPECT_EQ(wheel_names(DriveKind::kTracked)[1], "right");
  EXPECT_EQ(wheel_names(DriveKind::kOmnidirectional)[2], "rear_left");
}

TEST(Wheels, TravelIsTheMeanSpeedTimesTime) {
  const PerWheel way = travel({{0.0, 1.0, 0.5, 0.0}, {1.0, 1.0, -0.5, 0.0}, 2 * kSecond});
  EXPECT_DOUBLE_EQ(way[0], 1.0);
  EXPECT_DOUBLE_EQ(way[1], 2.0);
  EXPECT_EQ(way[2], 0.0);
}

/// Wheels give back the motion of the body: the mean of two is its way, their difference its turn.
TEST(Wheels, TravelIsTheMotionWithoutSlip) {
  testing::Dice dice(9);
  for (int i = 0; i < 100; ++i) {
    const DriveSpec all = testing::random_spec(dice);
    DriveSpec spec = all;
    spec.turn_slip = 0.0;
    Drive drive(spec, 1);
    double forward = 0.0, lateral = 0.0, turn = 0.0;
    for (std::int64_t t = kSecond; t <= 20 * kSecond; t += kSecond) {
      drive.command(t - kSecond, testing::random_command(dice));
      for (const Motion& motion : drive.advance(t)) {
        const double half = 0.5e-9 * static_cast<double>(motion.body.duration_ns);
        forward += half * (motion.body.from.forward_m_s + motion.body.to.forward_m_s);
        lateral += half * (motion.body.from.lateral_m_s + motion.body.to.lateral_m_s);
        turn += half * (motion.body.from.angular_rad_s + motion.body.to.angular_rad_s);
      }
    }
    const PlanarTwist way = twist_of(spec, drive.wheel_travel_m());
    EXPECT_NEAR(way.forward_m_s, forward, 1e-11);
    EXPECT_NEAR(way.lateral_m_s, lateral, 1e-11);
    EXPECT_NEAR(way.angular_rad_s, turn, 1e-10);
  }
}

}  // namespace
}  // namespace hallway::drive
