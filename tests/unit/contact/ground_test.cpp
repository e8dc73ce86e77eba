// SPDX-License-Identifier: MIT
// Floors, ramps, steps and ledges.
#include "contact/ground.hpp"

#include <gtest/gtest.h>

#include "unit/contact/scene.hpp"

namespace hallway::contact::test {
namespace {

constexpr double kYaw = 0.7;

/// A body level at a height.
Pose level(double x, double y, double z, double yaw = 0.0) {
  return {from_yaw_pitch_roll(yaw, 0, 0), Vec3(x, y, z)};
}

/// The vertical of a wheel: where it is while the body is level.
Vec2 vertical_of(const Pose& pose, const Vec2& wheel) {
  const Vec2 ahead = (pose.q * Vec3::UnitX()).head<2>().normalized();
  return pose.t.head<2>() + wheel.x() * ahead + wheel.y() * Vec2(-ahead.y(), ahead.x());
}

/// Height of the plane of the wheels on that vertical.
double height_of(const Pose& pose, const Vec2& wheel) {
  const Vec3 up = pose.q * Vec3::UnitZ();
  return pose.t.z() - up.head<2>().dot(vertical_of(pose, wheel) - pose.t.head<2>()) / up.z();
}

TEST(Ground, LevelFloorIsExact) {
  for (const double z : {0.0, 0.1, -3.3, 1234.5678}) {
    Scene scene;
    scene.floor(-3, -2, 5, 7, z);
    scene.box({0, 0}, 1, 1, z + 0.5, z + 1);  // above it
    const Obstacles obstacles(scene.triangles);
    for (const Wheels& wheels : {trike(), square_wheels()}) {
      const Ground ground(obstacles, wheels, {});
      Dice dice(1);
      for (int i = 0; i < 200; ++i) {
        const Pose guess = level(dice.in(-2, 4), dice.in(-1, 6), z + dice.in(-0.015, 0.015), dice.in(-3, 3));
        const Stance stance = ground.stand(guess);
        ASSERT_FALSE(stance.fault);
        EXPECT_EQ(stance.pose.t, Vec3(guess.t.x(), guess.t.y(), z));
        EXPECT_EQ(stance.pose.q.coeffs(), guess.q.coeffs());
      }
    }
  }
}

TEST(Ground, RampTiltsTheBody) {
  Scene scene;
  scene.ramp(-10, 10, -2, 2);  // z = 0.2 x
  const Obstacles obstacles(scene.triangles);
  for (const Wheels& wheels : {trike(), square_wheels()}) {
    const Ground ground(obstacles, wheels, {0.05, 0.05, 0.35, 0.05, false});
    const Stance stance = ground.stand(level(1.0, 0.3, 0.2, kYaw));
    ASSERT_FALSE(stance.fault);
    EXPECT_NEAR(stance.pose.t.z(), 0.2, 1e-12);
    const Vec3 up = stance.pose.q * Vec3::UnitZ(), ahead = stance.pose.q * Vec3::UnitX();
    EXPECT_NEAR((up - Vec3(-0.2, 0, 1).normalized()).norm(), 0.0, 1e-12);
    EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), kYaw, 1e-12);
    EXPECT_NEAR(up.dot(ahead), 0.0, 1e-12);
  }
  const Ground careful(obstacles, trike(), {0.05, 0.05, 0.19, 0.05, false});
  EXPECT_EQ(careful.stand(level(1.0, 0.3, 0.2)).fault, GroundFault::kSlope);
}

TEST(Ground, WhereABodyStandsItStandsAgain) {
  Scene scene;
  scene.floor(-9, -9, 15, 9, -0.6);
  scene.ramp(0.0, 4.8, 0.0, -0.6, 1.0);  // its sides end 0 to 6 cm above the floor there
  scene.box({7.0, 0.0}, 1.0, 1.0, -0.6, -0.578);
  const Obstacles obstacles(scene.triangles);
  const Wheels diamond{{Vec2(0.0, 0.15), Vec2(0.0, -0.15), Vec2(0.15, 0.0), Vec2(-0.15, 0.0)}, Vec2::Zero()};
  Dice dice(5);
  int stood = 0, refused = 0, hung = 0;
  for (const Wheels& wheels : {diamond, square_wheels(), trike()}) {
    const Ground ground(obstacles, wheels, {0.025, 0.025, 0.35, 0.03, false});
    for (int i = 0; i < 20'000; ++i) {
      const Vec2 at(dice.in(4.2, 7.7), dice.in(-1.3, 1.3));
      const double floor = ground.floor_at(at, -1.0, 1.0).value();
      const Stance stance = ground.settle(level(at.x(), at.y(), floor, dice.in(-3.1, 3.1)));
      if (stance.fault) {
        ++refused;
        continue;
      }
      ++stood;
      double highest = 0.0;  // of a wheel above what is under it
      for (const Vec2& wheel : wheels.at) {
        const double z = height_of(stance.pose, wheel);
        const auto under = ground.floor_at(vertical_of(stance.pose, wheel), z - 0.1, z + 1e-6);
        ASSERT_TRUE(under);
        highest = std::max(highest, z - *under);
      }
      EXPECT_LE(highest, 0.9 * 0.025 + 1e-6);
      if (highest > 0.005) ++hung;
      const Stance again = ground.stand(stance.pose);
      ASSERT_FALSE(again.fault) << i << " at " << at.transpose() << ", a wheel hangs by " << highest;
      EXPECT_NEAR((again.pose.t - stance.pose.t).norm(), 0.0, 1e-9);
    }
  }
  EXPECT_GT(stood, 40'000);
  EXPECT_GT(refused, 100);
  EXPECT_GT(hung, 500);
}

TEST(Ground, StepsAndLedges) {
  Scene scene;
  scene.floor(-5, -5, 0, 5, 0.0);
  scene.floor(0, -5, 5, 5, 0.03);
  const Obstacles obstacles(scene.triangles);
  const auto fault = [&](double step, double ledge, double z) {
    return Ground(obstacles, trike(), {step, ledge, 0.35, 0.05, false}).stand(level(-0.05, 0, z)).fault;
  };
  EXPECT_EQ(fault(0.031, 0.01, 0.0), std::nullopt);
  EXPECT_EQ(fault(0.029, 0.01, 0.0), GroundFault::kStep);
  EXPECT_EQ(fault(0.01, 0.031, 0.03), std::nullopt);
  EXPECT_EQ(fault(0.01, 0.029, 0.03), GroundFault::kLedge);
  const Stance stance = Ground(obstacles, trike(), {0.05, 0.05, 0.35, 0.05, false}).stand(level(-0.05, 0, 0));
  // The front wheels are 0.03 higher than the rear one, 0.2 m behind them.
  const Vec3 ahead = stance.pose.q * Vec3::UnitX();
  EXPECT_NEAR(ahead.z() / ahead.x(), 0.15, 1e-9);
  EXPECT_EQ(Ground(obstacles, trike(), {0.05, 0.05, 0.1, 0.05, false}).stand(level(-0.05, 0, 0)).fault,
            GroundFault::kSlope);
}

TEST(Ground, FourWheelsStandOnThree) {
  // One support is higher: a body of four wheels rocks on it and stands on the three that hold its centre of mass.
  for (const Vec2& centre : {Vec2(0.02, -0.03), Vec2(-0.03, 0.02), Vec2(0.0, 0.0)}) {
    for (std::size_t high = 0; high < 4; ++high) {
      Scene scene;
      scene.floor(-5, -5, 5, 5);
      Wheels wheels = square_wheels();
      wheels.centre_of_mass = centre;
      scene.box(wheels.at[high], 0.05, 0.05, -1.0, 0.02);
      const Obstacles obstacles(scene.triangles);
      const Stance stance = Ground(obstacles, wheels, {0.05, 0.05, 0.35, 0.05, false}).stand(level(0, 0, 0));
      ASSERT_FALSE(stance.fault);
      int touching = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const double height = height_of(stance.pose, wheels.at[i]) - (i == high ? 0.02 : 0.0);
        EXPECT_GE(height, -1e-9);
        touching += height < 1e-9 ? 1 : 0;
      }
      EXPECT_EQ(touching, 3);
    }
  }
}

TEST(Ground, HangingWheels) {
  Scene scene;
  scene.floor(-5, -5, 0, 5);
  const Obstacles obstacles(scene.triangles);
  GroundLimits limits{0.05, 0.05, 0.35, 0.05, true};
  Wheels wheels{{Vec2(0.2, 0.1), Vec2(-0.1, 0.1), Vec2(-0.1, -0.1), Vec2(0.05, -0.1)}, Vec2(-0.05, 0.0)};
  EXPECT_FALSE(Ground(obstacles, wheels, limits).stand(level(-0.15, 0, 0)).fault);  // one wheel hangs
  EXPECT_EQ(Ground(obstacles, wheels, limits).stand(level(0.05, 0, 0)).fault, GroundFault::kLedge);
  limits.may_hang = false;
  EXPECT_EQ(Ground(obstacles, wheels, limits).stand(level(-0.15, 0, 0)).fault, GroundFault::kLedge);
}

TEST(Ground, NoSeams) {
  // Wheels on edges and corners of triangles.
  Scene scene;
  for (int i = -10; i < 10; ++i) {
    for (int j = -10; j < 10; ++j) scene.floor(0.1 * i, 0.1 * j, 0.1 * (i + 1), 0.1 * (j + 1));
  }
  const Obstacles obstacles(scene.triangles);
  const Ground ground(obstacles, square_wheels(), {});
  for (int i = -50; i <= 50; ++i) {
    for (const double y : {0.0, 0.1, 0.05, 0.013}) {
      const Stance stance = ground.stand(level(0.01 * i, y, 0));
      ASSERT_FALSE(stance.fault);
      EXPECT_EQ(stance.pose.t.z(), 0.0);
    }
  }
}

/// Drives straight on along x and gives where it stands then.
struct Driven {
  double x = 0.0, z = 0.0;
  Advance advance;
  Counts counts;
};
Driven drive_on(const Scene& scene, RobotSpec spec, double seconds, double start = -1.0) {
  const Obstacles obstacles(scene.triangles);
  Robot robot(obstacles, std::move(spec));
  EXPECT_EQ(robot.put({start, 0, 0}, 0, 0), Start::kStands);
  Driven driven;
  driven.advance = drive(robot, steady(0.5, 0, 0, seconds));
  driven.x = robot.pose().t.x();
  driven.z = robot.pose().t.z();
  driven.counts = robot.counts();
  return driven;
}

RobotSpec climber() {
  RobotSpec spec = box_robot(0.12, 0.12);  // hardly longer than its wheels
  spec.wheels = square_wheels(0.11);
  spec.ground = {0.025, 0.025, 0.35, 0.03, false};
  return spec;
}

TEST(GroundDrives, UpARampAtItsSpeedAlongIt) {
  Scene scene;
  scene.floor(-5, -3, 0, 3);
  scene.ramp(0, 10, 0, 2);
  const Driven driven = drive_on(scene, climber(), 8.0);
  EXPECT_NEAR(driven.z, 0.2 * driven.x, 1e-9);
  // 4 m along the floor and the ramp, but for the edge that it goes over.
  EXPECT_NEAR(driven.counts.distance_m, 4.0, 0.01);
  EXPECT_NEAR(1.0 + driven.x * std::hypot(1.0, 0.2), 4.0, 0.02);
  EXPECT_EQ(driven.counts.contacts, 0u);
}

TEST(GroundDrives, OverACrest) {
  Scene scene;
  scene.floor(-5, -3, 0, 3);
  scene.ramp(0, 2, 0, 0.3);
  scene.ramp(2, 4, 0.3, 0);
  scene.floor(4, -3, 9, 3);
  const Driven driven = drive_on(scene, climber(), 13.0);
  EXPECT_EQ(driven.z, 0.0);
  EXPECT_GT(driven.x, 5.2);
  EXPECT_EQ(driven.counts.contacts, 0u);
}

TEST(GroundDrives, RampTooSteep) {
  Scene scene;
  scene.floor(-5, -3, 0, 3);
  scene.ramp(0, 10, 0, 5);  // 0.46 rad
  RobotSpec spec = climber();
  spec.shape =
      BodyShape::box({-0.12, -0.12, 0.1}, {0.12, 0.12, 0.5});  // high enough that its wheels get there
  const Driven driven = drive_on(scene, spec, 6.0);
  EXPECT_LT(driven.x, 0.2);
  ASSERT_EQ(driven.advance.touching.size(), 1u);
  EXPECT_EQ(driven.advance.touching[0].kind, TouchKind::kSlope);
  EXPECT_NEAR(driven.advance.touching[0].normal.x(), -1.0, 0.1);
  EXPECT_GT(driven.counts.stood_ns, kSecond);
}

TEST(GroundDrives, StepWithinAndOver) {
  for (const double height : {0.02, 0.028, 0.2}) {
    Scene scene;
    scene.floor(-5, -3, 5, 3);
    scene.box({2, 0}, 4, 4, -0.5, height);
    const Driven driven = drive_on(scene, climber(), 4.0);
    if (height == 0.02) {
      EXPECT_EQ(driven.counts.contacts, 0u);
      EXPECT_NEAR(driven.z, height, 1e-12);
      EXPECT_GT(driven.x, 0.95);
    } else {
      EXPECT_LT(driven.x, -0.1);
      ASSERT_EQ(driven.advance.touching.size(), 1u);
      EXPECT_EQ(driven.advance.touching[0].kind, height < 0.03 ? TouchKind::kStep : TouchKind::kWall);
    }
  }
}

TEST(GroundDrives, LedgeIsAContact) {
  Scene scene;
  scene.floor(-5, -3, 0, 3);
  scene.floor(-5, -3, 9, 3, -0.5);
  const Obstacles obstacles(scene.triangles);
  Robot robot(obstacles, climber());
  ASSERT_EQ(robot.put({-1, 0, 0}, 0.2, 0), Start::kStands);
  const Advance advance = drive(robot, steady(0.5, 0, 0, 6.0));
  ASSERT_EQ(advance.touching.size(), 1u);
  EXPECT_EQ(advance.touching[0].kind, TouchKind::kLedge);
  EXPECT_NEAR(advance.touching[0].point.x(), 0.0, 1e-3);
  EXPECT_EQ(robot.pose().t.z(), 0.0);
  EXPECT_EQ(robot.counts().contacts, 1u);
  const double x = robot.pose().t.x();
  drive(robot, steady(-0.5, 0, 0, 1.0));  // and back
  EXPECT_NEAR(robot.pose().t.x(), x - 0.5 * std::cos(0.2), 1e-9);
}

TEST(GroundDrives, FallsToTheFloorBelow) {
  for (const double depth : {0.1, 0.5, 3.0}) {
    Scene scene;
    scene.box({-2.5, 0}, 5, 6, -depth, 0.0);  // a platform, sides included
    scene.floor(-9, -9, 9, 9, -depth);
    RobotSpec spec = climber();
    spec.falls = true;
    const Driven driven = drive_on(scene, spec, 6.0);
    ASSERT_EQ(driven.advance.falls.size(), 1u) << depth;
    EXPECT_NEAR(driven.advance.falls[0].height_m, depth, 0.05);
    EXPECT_NEAR(driven.z, -depth, 1e-12);
    EXPECT_GT(driven.x, 1.5);  // it drives on
    EXPECT_NEAR(1e-9 * static_cast<double>(driven.advance.falls[0].t_ns), 2.0, 0.3);
  }
}

TEST(GroundDrives, LostWithNothingBelow) {
  Scene scene;
  scene.floor(-5, -3, 0, 3);
  const Obstacles obstacles(scene.triangles);
  RobotSpec spec = climber();
  spec.falls = true;
  Robot robot(obstacles, spec);
  ASSERT_EQ(robot.put({-1, 0, 0}, 0, 0), Start::kStands);
  drive(robot, steady(0.5, 0, 0, 6.0));
  EXPECT_TRUE(robot.is_lost());
  EXPECT_EQ(robot.now_ns(), 6 * kSecond);
  const Pose there = robot.pose();
  drive(robot, steady(-0.5, 0, 0, 1.0));
  EXPECT_EQ(robot.pose().t, there.t);
}

}  // namespace
}  // namespace hallway::contact::test
