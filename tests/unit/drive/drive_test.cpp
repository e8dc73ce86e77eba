// SPDX-License-Identifier: MIT
#include "drive/drive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "unit/drive/drives.hpp"

namespace hallway::drive {
namespace {

using testing::kSecond;

constexpr std::int64_t kMs = 1'000'000;

TEST(Drive, LatencyIsExact) {
  Drive drive({.max_acceleration_m_s2 = 1.0, .latency_ns = 123'456'789}, 1);
  EXPECT_EQ(drive.command(kSecond, {0.5, 0.0, 0.0}).acts_from_ns, 1'123'456'789);
  for (const Motion& motion : drive.advance(1'123'456'789)) EXPECT_EQ(motion.body.to, PlanarTwist{});
  drive.advance(1'123'456'789 + 1000);
  EXPECT_NEAR(drive.twist().forward_m_s, 1e-6, 1e-18);
}

TEST(Drive, CommandHoldsUntilTheNextActs) {
  Drive drive({.latency_ns = 100 * kMs}, 1);
  drive.command(0, {0.3, 0.0, 0.0});
  drive.advance(5 * kSecond);
  drive.halt(5 * kSecond);
  drive.advance(5 * kSecond + 100 * kMs);
  EXPECT_EQ(drive.twist().forward_m_s, 0.3);
  drive.advance(5 * kSecond + 400 * kMs);
  EXPECT_EQ(drive.twist(), PlanarTwist{});
}

TEST(Drive, LateCommandActsFromThePresent) {
  Drive drive({}, 1);
  drive.advance(kSecond);
  EXPECT_EQ(drive.command(0, {0.3, 0.0, 0.0}).acts_from_ns, kSecond);
  drive.advance(2 * kSecond);
  EXPECT_EQ(drive.twist().forward_m_s, 0.3);
}

TEST(Drive, LaterCallCountsOfTwoAtOneTime) {
  Drive drive({}, 1);
  drive.command(kSecond, {0.3, 0.0, 0.0});
  drive.command(kSecond, {-0.2, 0.0, 0.0});
  drive.advance(3 * kSecond);
  EXPECT_EQ(drive.twist().forward_m_s, -0.2);
}

TEST(Drive, DeceleratesAtItsOwnRate) {
  Drive drive({.max_acceleration_m_s2 = 0.5, .max_deceleration_m_s2 = 2.0}, 1);
  drive.command(0, {0.4, 0.0, 0.0});
  drive.advance(400 * kMs);
  EXPECT_NEAR(drive.twist().forward_m_s, 0.2, 1e-15);
  drive.advance(kSecond);
  drive.halt(kSecond);
  drive.advance(kSecond + 100 * kMs);
  EXPECT_NEAR(drive.twist().forward_m_s, 0.2, 1e-15);
  drive.advance(kSecond + 200 * kMs);
  EXPECT_EQ(drive.twist().forward_m_s, 0.0);
}

TEST(Drive, CommandInItsDeadBandMovesNothing) {
  DriveSpec spec{.dead_band_m_s = 0.05, .dead_band_rad_s = 0.2};
  testing::add_noise(spec);
  Drive drive(spec, 1);
  EXPECT_TRUE(drive.command(0, {0.04, 0.0, 0.19}).clamps.dead_band);
  drive.advance(10 * kSecond);
  EXPECT_EQ(drive.wheel_travel_m(), PerWheel{});
}

TEST(Drive, TracksNeedMorePowerToTurn) {
  Drive drive({.kind = DriveKind::kTracked, .turn_slip = 0.5}, 1);
  drive.command(0, {0.0, 0.0, 2.0});
  drive.advance(5 * kSecond);
  EXPECT_NEAR(drive.twist().angular_rad_s, 1.0, 1e-15);
  EXPECT_NEAR(drive.driven().angular_rad_s, 2.0, 1e-15);
}

/// The share of a turn that tracks lose while they are commanded to turn by a rate, from half a second after the command.
double slip_of_turn(Drive& drive, double angular_rad_s) {
  const std::int64_t begin = drive.present_ns();
  drive.command(begin, {0.1, 0.0, angular_rad_s});
  drive.advance(begin + kSecond);
  return 1.0 - drive.twist().angular_rad_s / drive.driven().angular_rad_s;
}

TEST(Drive, TracksLoseAnotherShareOfEachTurn) {
  const DriveSpec spec{.kind = DriveKind::kTracked, .turn_slip = 0.25, .turn_slip_noise = 0.1};
  Drive drive(spec, 3);
  const double first = slip_of_turn(drive, 0.4);
  EXPECT_EQ(slip_of_turn(drive, 0.2), first) << "the same turn, slower";
  const double right = slip_of_turn(drive, -0.4);
  EXPECT_NE(right, first);
  EXPECT_EQ(slip_of_turn(drive, -0.3), right);
  drive.halt(drive.present_ns());
  drive.advance(drive.present_ns() + kSecond);
  EXPECT_NE(slip_of_turn(drive, -0.4), right) << "it went straight on between them";
  Drive again(spec, 3), other(spec, 4);
  EXPECT_EQ(slip_of_turn(again, 0.4), first);
  EXPECT_NE(slip_of_turn(other, 0.4), first);
}

TEST(Drive, SharesOfTurnsHaveTheirMeanAndDeviation) {
  Drive drive({.kind = DriveKind::kTracked, .turn_slip = 0.4, .turn_slip_noise = 0.1}, 5);
  constexpr int kTurns = 2000;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < kTurns; ++i) {
    const double slip = slip_of_turn(drive, i % 2 == 0 ? 0.4 : -0.4);
    sum += slip;
    squares += (slip - 0.4) * (slip - 0.4);
  }
  EXPECT_NEAR(sum / kTurns, 0.4, 4.0 * 0.1 / std::sqrt(kTurns));
  EXPECT_NEAR(std::sqrt(squares / kTurns), 0.1, 4.0 * 0.1 / std::sqrt(2.0 * kTurns));
}

TEST(Drive, SharesOfTurnsStayWithinTheirLimits) {
  Drive drive({.kind = DriveKind::kTracked, .turn_slip = 0.5, .turn_slip_noise = 1.0}, 5);
  double least = 1.0, most = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double slip = slip_of_turn(drive, i % 2 == 0 ? 0.4 : -0.4);
    least = std::min(least, slip);
    most = std::max(most, slip);
  }
  EXPECT_NEAR(least, 0.0, 1e-12);
  EXPECT_NEAR(most, kMostTurnSlip, 1e-12);
}

TEST(Drive, PiecesCoverTheTimeWithoutGaps) {
  DriveSpec spec{.latency_ns = 33 * kMs};
  testing::add_noise(spec);
  Drive drive(spec, 1);
  drive.command(5, {0.5, 0.0, 1.0});
  std::int64_t covered = 0;
  for (const Motion& motion : drive.advance(777'777'777)) {
    EXPECT_GT(motion.body.duration_ns, 0);
    EXPECT_EQ(motion.body.duration_ns, motion.wheels.duration_ns);
    covered += motion.body.duration_ns;
  }
  EXPECT_EQ(covered, 777'777'777);
  EXPECT_EQ(drive.present_ns(), covered);
  EXPECT_TRUE(drive.advance(covered).empty());
}

TEST(Drive, NoiseActsAtEveryKnot) {
  for (const DriveKind kind : testing::kKinds) {
    DriveSpec spec{.kind = kind};
    testing::add_noise(spec);
    Drive drive(spec, 7);
    Actuation actuation(spec, 7);
    drive.command(0, {0.3, 0.0, 0.5});
    actuation.begin_turn();
    for (std::int64_t t = 5 * kMs; t < 4 * kSecond; t += 5 * kMs) {
      drive.advance(t);
      if (t % kKnotNs != 0) continue;
      EXPECT_EQ(drive.twist(), actuation.at(t, drive.driven()).body);
    }
  }
}

TEST(Drive, TwistOfAContactFadesWhileTheWheelsGoOn) {
  Drive drive({.max_acceleration_m_s2 = 1.0}, 1);
  drive.command(0, {0.5, 0.0, 0.0});
  drive.advance(2 * kSecond);
  const double before = drive.wheel_travel_m()[0];
  drive.set_twist({0.0, 0.1, 0.0});
  EXPECT_NEAR(drive.twist().forward_m_s, 0.0, 1e-16);
  EXPECT_EQ(drive.twist().lateral_m_s, 0.1);
  PlanarPose pose;
  testing::drive_on(drive, 3 * kSecond, pose);
  EXPECT_EQ(drive.twist(), (PlanarTwist{0.5, 0.0, 0.0}));
  EXPECT_NEAR(pose.x_m, 0.5 - 0.5 * 0.5 * 0.5, 1e-12);  // half a second at half the speed
  EXPECT_NEAR(pose.y_m, 0.5 * 0.1 * 0.1, 1e-12);
  EXPECT_NEAR(drive.wheel_travel_m()[0] - before, 0.5, 1e-12);
}

TEST(Drive, BlockedMotorsAccelerateAnew) {
  Drive drive({.max_acceleration_m_s2 = 1.0}, 1);
  drive.command(0, {0.5, 0.0, 0.0});
  drive.advance(2 * kSecond);
  drive.stop();
  EXPECT_EQ(drive.twist(), PlanarTwist{});
  EXPECT_EQ(drive.driven(), PlanarTwist{});
  PlanarPose pose;
  testing::drive_on(drive, 3 * kSecond, pose);
  EXPECT_EQ(drive.twist().forward_m_s, 0.5);
  EXPECT_NEAR(pose.x_m, 0.125 + 0.25, 1e-12);
}

TEST(Drive, StandingCarKeepsItsSteering) {
  Drive drive({.kind = DriveKind::kAckermann}, 1);
  drive.command(0, {0.3, 0.0, 0.2});
  drive.advance(3 * kSecond);
  const double angle = drive.steering_rad();
  EXPECT_GT(angle, 0.1);
  EXPECT_TRUE(drive.command(3 * kSecond, {0.0, 0.0, -1.0}).clamps.left_out);
  drive.advance(6 * kSecond);
  EXPECT_EQ(drive.steering_rad(), angle);
  EXPECT_EQ(drive.twist(), PlanarTwist{});
}

TEST(Drive, MisuseIsAnError) {
  Drive drive({}, 1);
  drive.advance(kSecond);
  EXPECT_THROW(drive.advance(kSecond - 1), Error);
  EXPECT_THROW(drive.command(kSecond, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}), Error);
  EXPECT_THROW(drive.command(kSecond, {0.0, 0.0, std::numeric_limits<double>::infinity()}), Error);
}

}  // namespace
}  // namespace hallway::drive
