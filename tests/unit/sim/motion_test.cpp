// SPDX-License-Identifier: MIT
//
// The derivatives that sensors are given against differences of the poses that they are given.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "sim/path_motion.hpp"
#include "unit/sim/drive_world.hpp"

namespace hallway::sim::test {
namespace {

using sense::Kinematics;
using sense::Side;

constexpr std::int64_t kPeriod_ns = 100'000'000;

/// The greatest difference between the members of kinematics_at() and central differences of eighth order of what they are the
/// derivatives of, at random moments of an interval that are away from breaks.
struct Worst {
  double pose = 0.0, velocity = 0.0, acceleration = 0.0, rate = 0.0, slope = 0.0;
  int moments = 0;
};

Worst compare(const Motion& motion, std::int64_t begin_ns, std::int64_t end_ns, double step_s) {
  constexpr double kWeights[]{4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  const std::vector<double> breaks = motion.breaks_in(begin_ns, end_ns);
  const double length_s = static_cast<double>(end_ns - begin_ns) * 1e-9;
  const Random random(3, stream_id("moments"));
  Worst worst;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const double at = random.uniform(i, 0, 5.0 * step_s, length_s - 5.0 * step_s);
    if (std::ranges::any_of(breaks, [&](double b) { return std::abs(b - at) < 4.5 * step_s; })) continue;
    const auto state = [&](double after) { return motion.kinematics_at(begin_ns, after, Side::kAfter); };
    const Kinematics now = state(at);
    Vec3 velocity = Vec3::Zero(), acceleration = Vec3::Zero(), rate = Vec3::Zero(), slope = Vec3::Zero();
    for (int k = 1; k <= 4; ++k) {
      const Kinematics later = state(at + k * step_s), before = state(at - k * step_s);
      const double weight = kWeights[k - 1] / step_s;
      velocity += weight * (later.T_world_body.t - before.T_world_body.t);
      acceleration += weight * (later.velocity - before.velocity);
      rate += weight * (rotation_vector(now.T_world_body.q.conjugate() * later.T_world_body.q) -
                        rotation_vector(now.T_world_body.q.conjugate() * before.T_world_body.q));
      slope += weight * (later.angular_velocity - before.angular_velocity);
    }
    worst.velocity = std::max(worst.velocity, (velocity - now.velocity).norm());
    worst.acceleration = std::max(worst.acceleration, (acceleration - now.acceleration).norm());
    worst.rate = std::max(worst.rate, (rate - now.angular_velocity).norm());
    worst.slope = std::max(worst.slope, (slope - now.angular_acceleration).norm());
    const auto t_ns = begin_ns + std::llround(at * 1e9);
    const Kinematics whole = motion.kinematics_at(t_ns, 0.0, Side::kAfter);
    const Pose pose = motion.pose_at(t_ns);
    worst.pose = std::max(
        {worst.pose, (pose.t - whole.T_world_body.t).norm(), angle_between(pose.q, whole.T_world_body.q)});
    ++worst.moments;
  }
  return worst;
}

void expect_exact(const Worst& worst, double tolerance) {
  EXPECT_GT(worst.moments, 200);
  EXPECT_LT(worst.pose, 1e-7) << "of a whole nanosecond";
  EXPECT_LT(worst.velocity, tolerance);
  EXPECT_LT(worst.acceleration, tolerance);
  EXPECT_LT(worst.rate, tolerance);
  EXPECT_LT(worst.slope, tolerance);
}

map::Path ramp_with_corners(bool closed) {
  const std::vector<Vec3> waypoints{{0, 0, 0}, {6, 0, 1}, {6, 5, 0}, {-1, 4, 0.5}};
  return map::Path(map::RoundedPolyline(waypoints, closed, 0.8));
}

TEST(PathMotion, DerivativesAreThoseOfThePoses) {
  const map::Path polyline = ramp_with_corners(true);
  expect_exact(compare(PathMotion(polyline, 0.15, kPeriod_ns), 12'345'678'901, 40'000'000'000, 0.01), 1e-8);
  const map::Path eight(
      map::Lemniscate({.crossing = {1, 2, 3}, .heading = 0.4, .length_m = 20, .rise_m = 2}));
  expect_exact(compare(PathMotion(eight, 0.15, kPeriod_ns), 123'456'789, 40'000'000'000, 0.02), 1e-8);
}

TEST(PathMotion, BreaksAreWhereArcsBeginAndEnd) {
  const map::Path path = ramp_with_corners(false);
  const PathMotion motion(path, 0.1, kPeriod_ns);
  const auto end_ns = static_cast<std::int64_t>(path.length_m() * 1e9) + 5'000'000'000;
  const std::vector<double> breaks = motion.breaks_in(0, end_ns);
  ASSERT_EQ(breaks.size(), 5u) << "two corners, and the end";
  EXPECT_NEAR(breaks.back(), path.length_m(), 1e-9);
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const Kinematics before = motion.kinematics_at(0, breaks[i], Side::kBefore);
    const Kinematics after = motion.kinematics_at(0, breaks[i], Side::kAfter);
    EXPECT_LT((before.velocity - after.velocity).norm(), 1e-9);
    EXPECT_NEAR((before.acceleration - after.acceleration).norm(), 1.0 / 0.8, 1e-9);
  }
  EXPECT_NEAR(motion.kinematics_at(0, breaks.back(), Side::kBefore).velocity.norm(), 1.0, 1e-12);
  EXPECT_EQ(motion.kinematics_at(0, breaks.back(), Side::kAfter).velocity.norm(), 0.0)
      << "it stands at the end";
  // An interval's begin does not belong to it, its end does.
  const auto first_ns = static_cast<std::int64_t>(std::ceil(breaks[0] * 1e9));
  EXPECT_EQ(motion.breaks_in(0, first_ns).size() + motion.breaks_in(first_ns, end_ns).size(), 5u);
}

TEST(PathMotion, ClosedPathsBreakInEveryRound) {
  const map::Path path = ramp_with_corners(true);
  const PathMotion motion(path, 0.1, kPeriod_ns);
  const auto round_ns = static_cast<std::int64_t>(path.length_m() * 1e9);
  const std::vector<double> breaks = motion.breaks_in(round_ns / 2, round_ns / 2 + 3 * round_ns);
  EXPECT_EQ(breaks.size(), 3u * 8u);
  EXPECT_TRUE(std::ranges::is_sorted(breaks));
}

TEST(PathMotion, AnObstacleStopsItAtOnce) {
  const map::Path path = ramp_with_corners(true);
  const PathMotion motion(path, 0.1, kPeriod_ns, 2.05);
  EXPECT_GT(motion.kinematics_at(2'000'000'000, 0.0, Side::kAfter).velocity.norm(), 0.99);
  EXPECT_EQ(motion.kinematics_at(2'100'000'000, 0.0, Side::kAfter).velocity.norm(), 0.0);
  EXPECT_NEAR(motion.breaks_in(2'000'000'000, 3'000'000'000).at(0), 0.05, 1e-12);
  EXPECT_TRUE(motion.breaks_in(3'000'000'000, 9'000'000'000).empty());
  EXPECT_TRUE(PathMotion(path, 0.0, kPeriod_ns).breaks_in(0, 9'000'000'000).empty());
}

/// The greatest change of each member of kinematics_at() over a step, in [0, end).
struct Changes {
  double velocity = 0.0, acceleration = 0.0, rate = 0.0, slope = 0.0;
};

Changes changes(const Motion& motion, double end_s, double step_s) {
  Changes most;
  Kinematics now = motion.kinematics_at(0, 0.0, Side::kAfter);
  for (double at = step_s; at < end_s; at += step_s) {
    const Kinematics next = motion.kinematics_at(0, at, Side::kAfter);
    most.velocity = std::max(most.velocity, (next.velocity - now.velocity).norm());
    most.acceleration = std::max(most.acceleration, (next.acceleration - now.acceleration).norm());
    most.rate = std::max(most.rate, (next.angular_velocity - now.angular_velocity).norm());
    most.slope = std::max(most.slope, (next.angular_acceleration - now.angular_acceleration).norm());
    now = next;
  }
  return most;
}

map::Path smooth_ramp(bool closed) {
  const std::vector<Vec3> waypoints{{0, 0, 0}, {6, 0, 1}, {6, 5, 0}, {-1, 4, 0.5}};
  return map::Path(map::SmoothPolyline(waypoints, closed, 0.8));
}

TEST(SmoothPathMotion, DerivativesAreThoseOfThePoses) {
  const map::Path open = smooth_ramp(false), closed = smooth_ramp(true);
  expect_exact(compare(SmoothPathMotion(closed, SmoothPace(1.5)), 0, 40'000'000'000, 0.01), 1e-8);
  expect_exact(compare(SmoothPathMotion(open, SmoothPace(1.5, open.length_m())), 0, 15'000'000'000, 0.01),
               1e-8);
  const map::Path eight(
      map::Lemniscate({.crossing = {1, 2, 3}, .heading = 0.4, .length_m = 20, .rise_m = 2}));
  expect_exact(compare(SmoothPathMotion(eight, SmoothPace(1.5)), 0, 40'000'000'000, 0.02), 1e-8);
}

TEST(SmoothPathMotion, NothingJumps) {
  const map::Path path = smooth_ramp(false);
  const SmoothPathMotion motion(path, SmoothPace(1.5, path.length_m()));
  const double end_s = SmoothPace(1.5, path.length_m()).joints_s().back() + 1.0;
  const Changes coarse = changes(motion, end_s, 1e-3), fine = changes(motion, end_s, 1e-4);
  EXPECT_LT(fine.velocity, 0.11 * coarse.velocity);
  EXPECT_LT(fine.acceleration, 0.11 * coarse.acceleration);
  EXPECT_LT(fine.rate, 0.11 * coarse.rate);
  EXPECT_LT(fine.slope, 0.15 * coarse.slope);
  // The same of arcs at constant speed, which jump.
  const map::Path rounded = ramp_with_corners(false);
  const PathMotion jumping(rounded, 0.15, kPeriod_ns);
  EXPECT_GT(changes(jumping, 8.0, 1e-4).acceleration, 0.9 * changes(jumping, 8.0, 1e-3).acceleration);
}

TEST(SmoothPathMotion, BothSidesOfABreakAreTheSame) {
  const map::Path path = smooth_ramp(true);
  const SmoothPathMotion motion(path, SmoothPace(1.5));
  const std::vector<double> breaks = motion.breaks_in(0, 40'000'000'000);
  EXPECT_GT(breaks.size(), 10u);
  EXPECT_TRUE(std::ranges::is_sorted(breaks));
  for (const double at : breaks) {
    const Kinematics before = motion.kinematics_at(0, at, Side::kBefore),
                     after = motion.kinematics_at(0, at, Side::kAfter);
    EXPECT_LT((before.acceleration - after.acceleration).norm(), 1e-9);
    EXPECT_LT((before.angular_acceleration - after.angular_acceleration).norm(), 1e-9);
  }
}

TEST(SmoothPace, GoesFromRestToRest) {
  const SmoothPace pace(1.5, 20.0);
  EXPECT_EQ(pace.at(-1.0).way_m, 0.0);
  EXPECT_EQ(pace.at(0.0).speed_m_s, 0.0);
  const double end_s = pace.joints_s().back();
  EXPECT_NEAR(end_s, 20.0 / 1.5 + 1.875 * 1.5, 1e-12) << "each ramp loses half of its time";
  EXPECT_EQ(pace.at(end_s + 1.0).way_m, 20.0);
  EXPECT_EQ(pace.at(end_s + 1.0).speed_m_s, 0.0);
  double fastest = 0.0, strongest = 0.0, before_m = 0.0;
  for (double t_s = 0.0; t_s < end_s; t_s += 1e-3) {
    const SmoothPace::State now = pace.at(t_s);
    EXPECT_GE(now.way_m, before_m);
    before_m = now.way_m;
    fastest = std::max(fastest, now.speed_m_s);
    strongest = std::max(strongest, std::abs(now.acceleration_m_s2));
    EXPECT_NEAR(pace.at(pace.time_of(now.way_m)).way_m, now.way_m, 1e-12);
  }
  EXPECT_EQ(fastest, 1.5);
  EXPECT_NEAR(strongest, SmoothPace::kAcceleration_m_s2, 1e-5);
}

TEST(SmoothPace, IsSlowerOnAShortWay) {
  const SmoothPace pace(10.0, 3.0);
  double fastest = 0.0, strongest = 0.0;
  for (double t_s = 0.0; t_s < 20.0; t_s += 1e-3) {
    fastest = std::max(fastest, pace.at(t_s).speed_m_s);
    strongest = std::max(strongest, std::abs(pace.at(t_s).acceleration_m_s2));
  }
  EXPECT_NEAR(fastest * fastest, 3.0 / 1.875, 1e-5);
  EXPECT_NEAR(strongest, 1.0, 1e-5);
  EXPECT_EQ(pace.at(20.0).way_m, 3.0);
  EXPECT_EQ(SmoothPace(1.0, 0.0).at(9.0).way_m, 0.0);
  EXPECT_EQ(SmoothPace(0.0, 5.0).at(9.0).way_m, 0.0);
  EXPECT_TRUE(SmoothPace(0.0, 5.0).joints_s().empty());
}

TEST(DrivenMotion, DerivativesAreThoseOfThePoses) {
  DriveWorld driven(driven_text("driven_by = 'plugin'\n",
                                "kind = 'omnidirectional'\nmax_acceleration_m_s2 = 0.3\n",
                                "latency_s = 20\n"));
  for (int i = 0; i < 60; ++i) {
    driven.robot->obey(
        {.command = drive::Command{
             .forward_m_s = 0.2, .lateral_m_s = 0.1 - 0.002 * i, .angular_rad_s = i < 30 ? 0.5 : -0.8}});
    driven.robot->advance();
  }
  const std::vector<double> breaks = driven.robot->breaks_in(0, 6'000'000'000);
  EXPECT_GT(breaks.size(), 10u) << "each command ends a ramp";
  expect_exact(compare(*driven.robot, 0, 6'000'000'000, 0.002), 1e-7);
}

}  // namespace
}  // namespace hallway::sim::test
