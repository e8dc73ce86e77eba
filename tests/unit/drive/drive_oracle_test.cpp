// SPDX-License-Identifier: MIT
// A minute of commands against motions that are worked out by hand and integrated by a quadrature that shares nothing with the library.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "drive/drive.hpp"
#include "support/planar_quadrature.hpp"
#include "unit/drive/drives.hpp"

namespace hallway::drive {
namespace {

using testing::kSecond;

constexpr double kTolerance = 1e-9;  // [m], [rad]

/// A number over time by its corners: seconds and values.
using Corners = std::vector<std::pair<long double, long double>>;

long double value_at(const Corners& corners, long double t) {
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const auto& [t0, a] = corners[i - 1];
    const auto& [t1, b] = corners[i];
    if (t <= t1) return a + (b - a) * (t - t0) / (t1 - t0);
  }
  return corners.back().second;
}

// From rest: targets at 0 s, 20 s and 40 s; 0.5 m/s^2 up, 1 m/s^2 down, 2 rad/s^2; the steering at 1 rad/s.
const Corners kForward{{0, 0},         {1, 0.5L},   {20, 0.5L}, {20.5L, 0},
                       {21.1L, -0.3L}, {40, -0.3L}, {40.3L, 0}, {41.1L, 0.4L}};
const Corners kLateral{{0, 0},         {0.6L, 0.3L}, {20, 0.3L}, {20.3L, 0},
                       {20.7L, -0.2L}, {40, -0.2L},  {40.2L, 0}, {40.4L, 0.1L}};
const Corners kAngular{{0, 0},          {0.4L, 0.8L}, {20, 0.8L},  {20.4L, 0},
                       {20.65L, -0.5L}, {40, -0.5L},  {40.25L, 0}, {40.35L, 0.2L}};
const Corners kSteering{{0, 0},         {0.4L, 0.4L}, {20, 0.4L}, {20.4L, 0},
                        {20.7L, -0.3L}, {40, -0.3L},  {40.3L, 0}, {40.5L, 0.2L}};
constexpr long double kAxle = 0.5L;

DriveSpec spec_of(DriveKind kind) {
  DriveSpec spec{.kind = kind, .axle_distance_m = 0.5};
  spec.max_steering_rate_rad_s = 1.0;
  spec.max_speed_m_s = 2.0;
  spec.max_angular_rad_s = 5.0;
  spec.max_acceleration_m_s2 = 0.5;
  spec.max_deceleration_m_s2 = 1.0;
  spec.max_angular_acceleration_rad_s2 = 2.0;
  if (kind == DriveKind::kTracked) spec.turn_slip = 0.25;
  return spec;
}

/// The turn of a car: by its steering, linear between times 10 ms apart.
long double car_turn(long double t) {
  const auto turn = [](long double at) {
    return value_at(kForward, at) * std::tan(value_at(kSteering, at)) / kAxle;
  };
  const long double knot = std::floor(t * 100.0L + 1e-9L) / 100.0L;
  return turn(knot) + (turn(knot + 0.01L) - turn(knot)) * (t - knot) * 100.0L;
}

oracle::Rates rates_of(DriveKind kind, long double t) {
  const long double forward = value_at(kForward, t);
  switch (kind) {
    case DriveKind::kDifferential:
      return {forward, 0, value_at(kAngular, t)};
    case DriveKind::kTracked:
      return {forward, 0, 0.75L * value_at(kAngular, t)};
    case DriveKind::kAckermann:
      return {forward, 0, car_turn(t)};
    case DriveKind::kOmnidirectional:
      break;
  }
  return {forward, value_at(kLateral, t), value_at(kAngular, t)};
}

Command command_at(DriveKind kind, long double t) {
  const auto at = [&](const Corners& corners) { return static_cast<double>(value_at(corners, t)); };
  if (kind == DriveKind::kAckermann) return {at(kForward), 0.0, at(kForward) * std::tan(at(kSteering)) / 0.5};
  return {at(kForward), kind == DriveKind::kOmnidirectional ? at(kLateral) : 0.0, at(kAngular)};
}

TEST(DriveOracle, MinuteOfRampsWhileTurning) {
  for (const DriveKind kind : testing::kKinds) {
    Drive drive(spec_of(kind), 1);
    PlanarPose pose;
    for (int part = 0; part < 3; ++part) {
      const Obeyed obeyed = drive.command(20 * part * kSecond, command_at(kind, 20 * part + 15));
      EXPECT_FALSE(obeyed.clamps.any_limit() || obeyed.clamps.left_out);
      testing::drive_on(drive, 20 * (part + 1) * kSecond, pose);
    }
    const oracle::Place place =
        oracle::integrate([&](long double t) { return rates_of(kind, t); }, 60'000, 0.001L);
    EXPECT_NEAR(pose.x_m, static_cast<double>(place.x), kTolerance) << name_of(kind);
    EXPECT_NEAR(pose.y_m, static_cast<double>(place.y), kTolerance) << name_of(kind);
    EXPECT_NEAR(pose.yaw_rad, static_cast<double>(place.yaw), kTolerance) << name_of(kind);
  }
}

TEST(DriveOracle, LinesOfTenMillisecondsAreNearACarsTurn) {
  const auto rates = [](long double t) -> oracle::Rates {
    const long double forward = value_at(kForward, t);
    return {forward, 0, forward * std::tan(value_at(kSteering, t)) / kAxle};
  };
  const oracle::Place exact = oracle::integrate(rates, 60'000, 0.001L);
  const oracle::Place lines =
      oracle::integrate([](long double t) { return rates_of(DriveKind::kAckermann, t); }, 60'000, 0.001L);
  EXPECT_NEAR(static_cast<double>(exact.x - lines.x), 0.0, 5e-4);
  EXPECT_NEAR(static_cast<double>(exact.y - lines.y), 0.0, 5e-4);
}

/// From rest to a constant twist: the circle begins after the ramp, whose part is added by the oracle.
TEST(DriveOracle, CarsCircleHasTheRadiusOfItsSteering) {
  DriveSpec spec = spec_of(DriveKind::kAckermann);
  Drive drive(spec, 1);
  drive.command(0, {0.5, 0.0, 0.5 * std::tan(0.4) / 0.5});
  drive.advance(2 * kSecond);
  EXPECT_NEAR(drive.steering_rad(), 0.4, 1e-15);
  PlanarPose pose;
  const double radius = 0.5 / std::tan(0.4);
  for (int i = 1; i <= 60; ++i) {
    testing::drive_on(drive, (2 + i) * kSecond, pose);
    EXPECT_NEAR(std::hypot(pose.x_m, pose.y_m - radius), radius, kTolerance);
    EXPECT_NEAR(pose.yaw_rad, i * 0.5 / radius, kTolerance);
  }
}

TEST(DriveOracle, StraightSidewaysAndCircleHaveClosedForms) {
  Drive straight(spec_of(DriveKind::kDifferential), 1);
  PlanarPose pose;
  straight.command(0, {0.5, 0.0, 0.0});
  testing::drive_on(straight, 60 * kSecond, pose);
  EXPECT_NEAR(pose.x_m, 0.25 + 59 * 0.5, kTolerance);
  EXPECT_EQ(pose.y_m, 0.0);

  Drive sideways(spec_of(DriveKind::kOmnidirectional), 1);
  pose = {};
  sideways.command(0, {0.0, -0.5, 0.0});
  testing::drive_on(sideways, 60 * kSecond, pose);
  EXPECT_EQ(pose.x_m, 0.0);
  EXPECT_NEAR(pose.y_m, -0.25 - 59 * 0.5, kTolerance);

  Drive circle(spec_of(DriveKind::kDifferential), 1);
  circle.command(0, {0.5, 0.0, 0.25});
  circle.advance(2 * kSecond);
  pose = {};
  testing::drive_on(circle, 62 * kSecond, pose);
  EXPECT_NEAR(pose.x_m, 2.0 * std::sin(15.0), kTolerance);
  EXPECT_NEAR(pose.y_m, 2.0 - 2.0 * std::cos(15.0), kTolerance);
}

}  // namespace
}  // namespace hallway::drive
