// SPDX-License-Identifier: MIT
#include "icp/core/screw.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clouds.hpp"
#include "icp/core/scan_motion.hpp"

namespace hallway::icp {
namespace {

constexpr std::int64_t kScan_ns = 100'000'000;

/// Where a sensor is that drives a circle of `radius_m` to the left about its start's y axis, in closed form.
Pose on_circle(double speed_m_s, double rate_rad_s, double t_s) {
  const double angle = rate_rad_s * t_s, radius_m = speed_m_s / rate_rad_s;
  return clouds::pose({radius_m * std::sin(angle), radius_m * (1.0 - std::cos(angle)), 0.0}, angle);
}

TEST(Screw, IsTheInverseOfItsMotion) {
  clouds::Random random(1);
  for (int i = 0; i < 200; ++i) {
    Vec6 screw;
    screw << random.in_box({3, 3, 3}), random.in_box({1.5, 1.5, 1.5}) * std::pow(10.0, -(i % 9));
    EXPECT_NEAR((screw_of(screw_motion(screw)) - screw).norm(), 0.0, 1e-9);
  }
}

TEST(Screw, MakesACircleOfConstantVelocities) {
  Vec6 screw;
  screw << 2.0, 0.0, 0.0, 0.0, 0.0, 1.25;
  const Pose expected = on_circle(2.0, 1.25, 1.0);
  EXPECT_NEAR(clouds::gap(screw_motion(screw), expected), 0.0, 1e-12);
}

TEST(Deskewing, PutsPointsOfAKnownMotionWhereTheyWereMet) {
  // Fixed points, each seen from where the sensor is at its own moment of a circle at 3 m/s and 4 rad/s.
  MotionTrack track;
  for (int k = 0; k <= 5; ++k) track.add(k * kScan_ns / 5, on_circle(3.0, 4.0, 0.02 * k));
  const Points world = clouds::scattered(1000, 3);
  Points seen;
  std::vector<std::int64_t> times;
  for (std::size_t i = 0; i < world.size(); ++i) {
    times.push_back(kScan_ns * static_cast<std::int64_t>(i) / 1000);
    seen.push_back(on_circle(3.0, 4.0, 1e-9 * static_cast<double>(times.back())).inverse() * world[i]);
  }
  const Points straight = deskewed(seen, times, kScan_ns, track);
  const Pose T_world_end = on_circle(3.0, 4.0, 0.1);
  for (std::size_t i = 0; i < world.size(); ++i)
    EXPECT_NEAR((T_world_end * straight[i] - world[i]).norm(), 0.0, 1e-9);
}

TEST(MotionTrack, GoesOnBeyondItsEndsAndForgetsOnlyWhatIsNotNeeded) {
  MotionTrack track;
  for (int k = 0; k <= 10; ++k) track.add(k * kScan_ns, on_circle(1.0, 0.5, 0.1 * k));
  track.add(5 * kScan_ns, Pose());  // late: passed over
  EXPECT_EQ(track.size(), 11u);
  EXPECT_NEAR(clouds::gap(track.at(12 * kScan_ns), on_circle(1.0, 0.5, 1.2)), 0.0, 1e-9);
  const Pose before = track.at(7 * kScan_ns + kScan_ns / 2);
  track.forget_before(7 * kScan_ns + kScan_ns / 4);
  EXPECT_LT(track.size(), 6u);
  EXPECT_EQ(clouds::gap(track.at(7 * kScan_ns + kScan_ns / 2), before), 0.0);
}

TEST(ScanMotion, UsesTheBestSourceThatCoversTheScan) {
  ScanMotion motion;
  EXPECT_EQ(motion.source(Deskew::automatic, 0, kScan_ns), Deskew::motion);
  motion.add(RateReading{0, kScan_ns, {0.0, 0.0, 1.0}});
  EXPECT_EQ(motion.source(Deskew::automatic, 0, kScan_ns), Deskew::imu);
  EXPECT_EQ(motion.source(Deskew::odometry, 0, kScan_ns), Deskew::motion);
  motion.add(OdometryReading{0, Pose(), Mat6::Zero()});
  motion.add(OdometryReading{kScan_ns, clouds::pose({0.1, 0, 0}, 0.1), Mat6::Zero()});
  EXPECT_EQ(motion.source(Deskew::automatic, 0, kScan_ns), Deskew::odometry);
  EXPECT_EQ(motion.source(Deskew::imu, 0, kScan_ns), Deskew::imu);
  EXPECT_EQ(motion.source(Deskew::automatic, 2 * kScan_ns, 3 * kScan_ns), Deskew::motion);
  const Expected expected = motion.expected(Deskew::odometry, 0, kScan_ns, Vec6::Zero());
  EXPECT_NEAR(clouds::gap(expected.motion, clouds::pose({0.1, 0, 0}, 0.1)), 0.0, 1e-12);
}

}  // namespace
}  // namespace hallway::icp
