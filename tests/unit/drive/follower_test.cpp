// SPDX-License-Identifier: MIT
#include "drive/follower.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "base/error.hpp"
#include "drive/drive.hpp"
#include "unit/drive/drives.hpp"

namespace hallway::drive {
namespace {

constexpr std::int64_t kPeriodNs = 100'000'000;

/// What a robot did on its way.
struct Ride {
  Pose pose{};
  FollowStep last{};
  double farthest_m = 0.0;       ///< greatest distance from the path, after the first metre
  double greatest_step_m = 0.0;  ///< greatest progress of a step
  bool went_back = false;        ///< the progress shrank
  double speed_m_s = 0.0;        ///< at the end
};

Ride ride(Follower follower, const DriveSpec& spec, Pose start, int steps) {
  Drive drive(spec, 17);
  Ride result{.pose = start};
  for (int i = 1; i <= steps && !(result.last.done && drive.twist() == PlanarTwist{}); ++i) {
    const FollowStep step = follower.next(result.pose);
    result.went_back = result.went_back || step.along_m < result.last.along_m;
    result.greatest_step_m = std::max(result.greatest_step_m, step.along_m - result.last.along_m);
    if (step.along_m > 1.0) result.farthest_m = std::max(result.farthest_m, step.distance_m);
    const Obeyed obeyed = drive.command(drive.present_ns(), step.command);
    EXPECT_FALSE(obeyed.clamps.angular || obeyed.clamps.speed || obeyed.clamps.left_out);
    for (const Motion& motion : drive.advance(i * kPeriodNs)) result.pose = move(result.pose, motion.body);
    result.last = step;
  }
  result.speed_m_s = drive.twist().forward_m_s;
  return result;
}

DriveSpec spec_for(DriveKind kind) {
  DriveSpec spec{.kind = kind};
  if (kind == DriveKind::kTracked) spec.turn_slip = 0.3;
  return spec;
}

std::vector<Vec3> sampled(int count, const std::function<Vec3(double)>& at) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(at(2.0 * std::numbers::pi * i / count));
  return points;
}

std::vector<Vec3> eight() {
  return sampled(1000,
                 [](double t) { return Vec3(3.0 * std::sin(t), 3.0 * std::sin(t) * std::cos(t), 0.0); });
}

TEST(Follower, StraightLineIsReachedAndEnded) {
  for (const DriveKind kind : testing::kKinds) {
    const DriveSpec spec = spec_for(kind);
    const Follower follower({{0.0, 0.0, 0.0}, {6.0, 0.0, 0.0}}, spec, {});
    const Ride result = ride(follower, spec, {Quat::Identity(), {0.0, 0.2, 0.0}}, 600);
    EXPECT_TRUE(result.last.done) << name_of(kind);
    EXPECT_FALSE(result.last.lost);
    EXPECT_EQ(result.speed_m_s, 0.0);
    EXPECT_NEAR(result.pose.t.x(), 6.0, 0.02) << name_of(kind);
    EXPECT_NEAR(result.pose.t.y(), 0.0, 0.005) << name_of(kind);
  }
}

TEST(Follower, EndIsReachedWithLatencyAndDeadBand) {
  for (const DriveKind kind : testing::kKinds) {
    DriveSpec spec = spec_for(kind);
    spec.latency_ns = 200'000'000;
    spec.dead_band_m_s = 0.05;
    spec.max_deceleration_m_s2 = 0.4;
    const Follower follower({{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}}, spec, {.speed_m_s = 0.6});
    const Ride result = ride(follower, spec, {}, 300);
    EXPECT_TRUE(result.last.done) << name_of(kind);
    EXPECT_EQ(result.speed_m_s, 0.0) << name_of(kind);
    EXPECT_NEAR(result.pose.t.x(), 3.0, 0.03) << name_of(kind);
  }
}

TEST(Follower, CircleIsKeptInTheSteadyState) {
  const auto points =
      sampled(2000, [](double t) { return Vec3(2.0 * std::sin(t), 2.0 - 2.0 * std::cos(t), 0.0); });
  for (const DriveKind kind : testing::kKinds) {
    const DriveSpec spec = spec_for(kind);
    const Follower follower(points, spec, {.closed = true});
    const Ride result = ride(follower, spec, {}, 900);
    EXPECT_GT(result.last.along_m, 2.0 * follower.length_m()) << name_of(kind);
    EXPECT_LT(result.last.distance_m, 0.001) << name_of(kind);
    EXPECT_NEAR((result.pose.t - Vec3(0.0, 2.0, 0.0)).norm(), 2.0, 0.001) << name_of(kind);
    EXPECT_FALSE(result.went_back);
  }
}

TEST(Follower, FigureEightIsFollowedThroughItsCrossing) {
  for (const bool noisy : {false, true}) {
    for (const DriveKind kind : testing::kKinds) {
      DriveSpec spec = spec_for(kind);
      if (noisy) testing::add_noise(spec);
      const Follower follower(eight(), spec, {.closed = true});
      const Ride result =
          ride(follower, spec, {from_yaw_pitch_roll(0.25 * std::numbers::pi, 0.0, 0.0), Vec3::Zero()}, 1500);
      EXPECT_GT(result.last.along_m, 2.0 * follower.length_m()) << name_of(kind);
      EXPECT_LT(result.farthest_m, noisy ? 0.15 : 0.06) << name_of(kind);
      EXPECT_LT(result.greatest_step_m, 0.06) << name_of(kind);
      EXPECT_FALSE(result.went_back);
    }
  }
}

TEST(Follower, RobotThatLooksBackTurns) {
  for (const DriveKind kind : testing::kKinds) {
    const DriveSpec spec = spec_for(kind);
    const Follower follower({{0.0, 0.0, 0.0}, {8.0, 0.0, 0.0}}, spec, {});
    const Ride result = ride(follower, spec, {from_yaw_pitch_roll(3.0, 0.0, 0.0), Vec3::Zero()}, 900);
    EXPECT_TRUE(result.last.done) << name_of(kind);
  }
}

TEST(Follower, SlopeDoesNotMatter) {
  const Follower follower({{0.0, 0.0, 0.0}, {3.0, 0.0, 1.0}}, {}, {});
  const Ride result =
      ride(follower, {}, {from_yaw_pitch_roll(0.0, -std::atan(1.0 / 3.0), 0.0), Vec3::Zero()}, 300);
  EXPECT_TRUE(result.last.done);
  EXPECT_NEAR(result.pose.t.z(), 1.0, 0.02);
}

TEST(Follower, SpeedFallsInBends) {
  DriveSpec spec{.max_speed_m_s = 0.6, .max_angular_rad_s = 0.3};
  Follower follower(
      sampled(500, [](double t) { return Vec3(0.5 * std::sin(t), 0.5 - 0.5 * std::cos(t), 0.0); }), spec,
      {.look_ahead_m = 0.2, .speed_m_s = 0.5, .closed = true});
  const Command command = follower.next({}).command;
  EXPECT_NEAR(command.angular_rad_s, 0.3, 1e-9);
  EXPECT_NEAR(command.forward_m_s, 0.15, 0.01);
}

TEST(Follower, LostRobotIsCommandedToStop) {
  Follower follower({{0.0, 0.0, 0.0}, {6.0, 0.0, 0.0}}, {}, {});
  EXPECT_FALSE(follower.next({Quat::Identity(), {0.0, 1.49, 0.0}}).lost);
  const FollowStep lost = follower.next({Quat::Identity(), {0.0, 1.51, 0.0}});
  EXPECT_TRUE(lost.lost);
  EXPECT_EQ(lost.command, Command{});
  EXPECT_FALSE(follower.next({Quat::Identity(), {0.1, 0.0, 0.0}}).lost);
}

TEST(Follower, CopyGoesOnAsTheOriginal) {
  Follower follower(eight(), {}, {.closed = true});
  follower.next({Quat::Identity(), {0.1, 0.1, 0.0}});
  Follower copy = follower;
  const Pose pose{Quat::Identity(), {0.3, 0.2, 0.0}};
  EXPECT_EQ(follower.next(pose).command, copy.next(pose).command);
}

TEST(Follower, BadSettingsAreRefused) {
  const std::vector<Vec3> line{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Follower(line, {}, {.look_ahead_m = 0.0}), Error);
  EXPECT_THROW(Follower(line, {}, {.speed_m_s = nan}), Error);
  EXPECT_THROW(Follower(line, {}, {.period_s = -1.0}), Error);
  EXPECT_THROW(Follower(line, {}, {.lost_look_aheads = 0.0}), Error);
  EXPECT_THROW(Follower(line, {.max_speed_m_s = nan}, {}), Error);
  EXPECT_THROW(Follower({}, {}, {}), Error);
}

}  // namespace
}  // namespace hallway::drive
