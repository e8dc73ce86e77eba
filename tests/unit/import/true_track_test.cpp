// SPDX-License-Identifier: MIT
#include "import/true_track.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace hallway::import {
namespace {

TimedPose at(std::int64_t t_ns, double x, double yaw = 0.0) {
  return {t_ns, {from_yaw_pitch_roll(yaw, 0, 0), Vec3(x, 0, 0)}};
}

TEST(TrueTrack, TheTimeItselfGivesThePoseToTheBit) {
  const TrueTrack track({at(100, 0.1, 0.3), at(200, 0.7)}, 0);
  ASSERT_TRUE(track.at(100));
  EXPECT_EQ(track.at(100)->t.x(), 0.1);
  EXPECT_EQ(track.at(100)->q.coeffs(), at(100, 0.1, 0.3).T_world_body.q.coeffs());
  EXPECT_FALSE(track.at(150));
}

TEST(TrueTrack, BetweenTwoNearOnesInProportionToTime) {
  const double turn = std::numbers::pi / 2;
  const TrueTrack track({at(100, 1.0, 0.0), at(200, 2.0, turn)}, 80);
  const auto pose = track.at(125);
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->t.x(), 1.25);
  EXPECT_NEAR(angle_between(pose->q, from_yaw_pitch_roll(turn / 4, 0, 0)), 0.0, 1e-12);
}

TEST(TrueTrack, TheShorterWayRound) {
  TimedPose other = at(200, 0.0, 0.2);
  other.T_world_body.q.coeffs() *= -1.0;  // the same rotation
  const TrueTrack track({at(100, 0.0, 0.0), other}, 100);
  EXPECT_NEAR(angle_between(track.at(150)->q, from_yaw_pitch_roll(0.1, 0, 0)), 0.0, 1e-12);
}

TEST(TrueTrack, OneNearPoseIsTakenAsItIs) {
  const TrueTrack track({at(100, 1.0), at(200, 2.0)}, 20);
  EXPECT_EQ(track.at(115)->t.x(), 1.0);
  EXPECT_EQ(track.at(185)->t.x(), 2.0);
  EXPECT_FALSE(track.at(150));
  EXPECT_EQ(track.at(80)->t.x(), 1.0);
  EXPECT_FALSE(track.at(79));
  EXPECT_EQ(track.at(220)->t.x(), 2.0);
  EXPECT_FALSE(track.at(221));
}

TEST(TrueTrack, WithoutPosesThereAreNone) {
  EXPECT_TRUE(TrueTrack().empty());
  EXPECT_FALSE(TrueTrack().at(0));
}

}  // namespace
}  // namespace hallway::import
