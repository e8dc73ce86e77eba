// SPDX-License-Identifier: MIT
// What a robot does at walls: slides, stops, turns away.
#include <gtest/gtest.h>

#include <numbers>

#include "contact/twist_limits.hpp"
#include "unit/contact/scene.hpp"

namespace hallway::contact::test {
namespace {

/// The least of a quadratic within half spaces, by projecting onto them in turn (Dykstra 1983).
Vec3 projected(const Vec3& wanted, const std::vector<std::pair<Vec3, double>>& rows) {
  Vec3 x = wanted;
  std::vector<Vec3> correction(rows.size(), Vec3::Zero());
  for (int round = 0; round < 20000; ++round) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Vec3 y = x + correction[i];
      const auto& [normal, least] = rows[i];
      x = y + normal * (std::max(0.0, least - normal.dot(y)) / normal.squaredNorm());
      correction[i] = y - x;
    }
  }
  return x;
}

TEST(TwistLimits, NearestAgreesWithAlternatingProjections) {
  Dice dice(5);
  const double gyration = 0.2;
  int limited = 0;
  for (int i = 0; i < 100; ++i) {
    std::vector<TwistLimit> limits;
    std::vector<std::pair<Vec3, double>> rows;
    const int count = 1 + dice.below(5);
    for (int k = 0; k < count; ++k) {
      const double angle = dice.in(0, 3.0);
      const TwistLimit limit{std::cos(angle), std::sin(angle), dice.in(-0.3, 0.3), -dice.in(0.0, 0.2)};
      limits.push_back(limit);
      rows.emplace_back(Vec3(limit.x, limit.y, limit.turn / gyration), limit.least);
    }
    const PlanarTwist wanted{dice.in(-1, 1), dice.in(-1, 1), dice.in(-5, 5)};
    const auto found = nearest_twist(wanted, limits, gyration);
    ASSERT_TRUE(found);
    const Vec3 expected =
        projected(Vec3(wanted.forward_m_s, wanted.lateral_m_s, wanted.angular_rad_s * gyration), rows);
    EXPECT_NEAR(found->forward_m_s, expected.x(), 1e-6) << i;
    EXPECT_NEAR(found->lateral_m_s, expected.y(), 1e-6) << i;
    EXPECT_NEAR(found->angular_rad_s * gyration, expected.z(), 1e-6) << i;
    limited += *found == wanted ? 0 : 1;
  }
  EXPECT_GT(limited, 30);
}

TEST(TwistLimits, NeverTurnsBack) {
  Dice dice(6);
  for (int i = 0; i < 2000; ++i) {
    std::vector<TwistLimit> limits;
    for (int k = 0; k < 1 + i % 8; ++k) {
      const double angle = dice.in(0, 6.3);
      limits.push_back({std::cos(angle), std::sin(angle), dice.in(-0.3, 0.3), 0.0});
    }
    const PlanarTwist wanted{dice.in(-1, 1), dice.in(-1, 1), dice.in(-5, 5)};
    const PlanarTwist found = nearest_twist(wanted, limits, 0.2).value();
    const double along = wanted.forward_m_s * found.forward_m_s + wanted.lateral_m_s * found.lateral_m_s +
                         0.04 * wanted.angular_rad_s * found.angular_rad_s;
    const double length2 = found.speed() * found.speed() + 0.04 * found.angular_rad_s * found.angular_rad_s;
    EXPECT_GE(along, length2 - 1e-9);
    for (const TwistLimit& limit : limits) EXPECT_GE(limit.speed(found), -1e-9);
    EXPECT_EQ(shortened_twist(wanted, limits)->angular_rad_s == 0.0,
              shortened_twist(wanted, limits)->is_zero());
  }
}

TEST(TwistLimits, NoTwistIsWithinLimitsThatContradict) {
  const std::vector<TwistLimit> squeezed{{1, 0, 0, 0.1}, {-1, 0, 0, 0.1}};
  EXPECT_FALSE(nearest_twist({1, 0, 0}, squeezed, 0.2));
  EXPECT_FALSE(shortened_twist({1, 0, 0}, squeezed));
}

Scene hall() {
  Scene scene;
  scene.floor(-20, -20, 20, 20);
  // A wall of many triangles: their edges must not stop anything.
  for (int i = -10; i < 10; ++i) scene.wall({static_cast<double>(i), 1.0}, {i + 1.0, 1.0});
  return scene;
}

TEST(Slide, AlongAWallAtTheTangentialSpeed) {
  const Obstacles obstacles(hall().triangles);
  for (const double angle : {0.1, 0.5, 1.0, 1.4}) {
    Robot robot(obstacles, round_robot());
    ASSERT_EQ(robot.put({-8, 0.79, 0}, 0.0, 0), Start::kStands);
    drive(robot, steady(std::cos(angle), std::sin(angle), 0, 0.5));
    const double before = robot.pose().t.x();
    const Advance advance = drive(robot, steady(std::cos(angle), std::sin(angle), 0, 4.0));
    EXPECT_NEAR(robot.pose().t.x() - before, 4.0 * std::cos(angle), 1e-6) << angle;
    EXPECT_NEAR(robot.pose().t.y(), 0.8 - kClearance, 1e-6);
    EXPECT_NEAR(robot.twist().forward_m_s, std::cos(angle), 1e-6);
    EXPECT_EQ(robot.counts().contacts, 1u);
    ASSERT_EQ(advance.touching.size(), 1u);
    EXPECT_NEAR(advance.touching[0].normal.y(), -1.0, 1e-6);
    EXPECT_NEAR(advance.touching[0].speed_m_s, std::sin(angle), 1e-6);
    EXPECT_EQ(advance.touching[0].kind, TouchKind::kWall);
    EXPECT_NEAR(advance.touching[0].point.y(), 1.0 - kClearance, 1e-6);
    EXPECT_EQ(robot.counts().stood_ns, 0);
  }
}

TEST(Slide, ABoxTurnsFlatAgainstAWall) {
  // Its corner meets the wall first; without friction the push turns it until a side lies on the wall.
  const Obstacles obstacles(hall().triangles);
  Robot robot(obstacles, box_robot());
  ASSERT_EQ(robot.put({-8, 0.5, 0}, 0.3, 0), Start::kStands);
  drive(robot, steady(1.0, 0.0, 0, 8.0));
  const Vec3 ahead = robot.pose().q * Vec3::UnitX();
  EXPECT_NEAR(ahead.y(), 0.0, 1e-2);
  EXPECT_GT(robot.pose().t.x(), -1.5);
  EXPECT_LE(robot.pose().t.y(), 1.0 - 0.15 - 0.5 * kClearance + 1e-9);
}

TEST(Slide, StopsHeadOn) {
  const Obstacles obstacles(hall().triangles);
  for (RobotSpec spec : {box_robot(), round_robot()}) {
    for (const bool slides : {true, false}) {
      spec.move.slide = slides;
      Robot robot(obstacles, spec);
      ASSERT_EQ(robot.put({0.3, 0, 0}, std::numbers::pi / 2, 0), Start::kStands);
      const Advance advance = drive(robot, steady(0.5, 0, 0, 4.0));
      EXPECT_NEAR(robot.pose().t.y(), 0.8 - kClearance, 1e-6);
      EXPECT_NEAR(robot.pose().t.x(), 0.3, 1e-6);
      EXPECT_LT(robot.twist().speed(), 1e-6);
      EXPECT_EQ(robot.counts().contacts, 1u);
      EXPECT_NEAR(1e-9 * static_cast<double>(robot.counts().stood_ns), 4.0 - 1.6, 0.1);
      ASSERT_EQ(advance.begun.size(), 1u);
      EXPECT_NEAR(1e-9 * static_cast<double>(advance.begun[0].t_ns), 1.6, 0.01);
      // It leaves as it is told: backwards, and turning.
      drive(robot, steady(-0.5, 0, 0, 1.0));
      EXPECT_NEAR(robot.pose().t.y(), 0.3 - kClearance, 1e-6);
      drive(robot, steady(0, 0, 1.0, 1.0));
      EXPECT_NEAR(angle_between(robot.pose().q, from_yaw_pitch_roll(std::numbers::pi / 2 + 1.0, 0, 0)), 0.0,
                  1e-4);
    }
  }
}

TEST(Slide, TurnsAwayFromAWall) {
  const Obstacles obstacles(hall().triangles);
  Robot round(obstacles, round_robot());
  ASSERT_EQ(round.put({0, 0.7, 0}, std::numbers::pi / 2, 0), Start::kStands);
  drive(round, steady(0.5, 0, 0, 1.0));
  drive(round, steady(0, 0, 2.0, 1.0));  // a round body turns freely where it touches
  EXPECT_NEAR(angle_between(round.pose().q, from_yaw_pitch_roll(std::numbers::pi / 2 + 2.0, 0, 0)), 0.0,
              1e-4);
  Robot box(obstacles, box_robot());
  ASSERT_EQ(box.put({0, 0.7, 0}, std::numbers::pi / 2, 0), Start::kStands);
  drive(box, steady(0.5, 0, 0, 1.0));
  drive(box, steady(0, 0, 1.5, 2.0));  // a box pushes itself off
  EXPECT_GT(angle_between(box.pose().q, from_yaw_pitch_roll(std::numbers::pi / 2, 0, 0)), 2.0);
}

TEST(Slide, TurnsAboutAPost) {
  // The side of a long box leans on a corner: it slides along it and turns about it.
  Scene scene;
  scene.floor(-20, -20, 20, 20);
  scene.box({0, 0.65}, 0.3, 0.3, 0.0, 1.0, 0.7853981634);
  const Obstacles obstacles(scene.triangles);
  Robot robot(obstacles, box_robot(0.5, 0.15));
  ASSERT_EQ(robot.put({0.1, 0.25, 0}, 0, 0), Start::kStands);
  drive(robot, steady(0.3, 0.3, 0, 0.5));
  drive(robot, steady(0.3, 0.3, 0, 3.0));
  EXPECT_GT(robot.counts().distance_m, 0.5);
  EXPECT_LT(robot.counts().parts, 5000u);
}

TEST(Slide, PassesAPostThatIsNotInItsWay) {
  Scene scene;
  scene.floor(-5, -5, 5, 5);
  scene.box({0, 0.3503}, 0.3, 0.3, 0.0, 1.0);     // 0.3 mm beside the way
  scene.box({0.5, -0.3502}, 0.3, 0.3, 0.0, 1.0);  // 0.2 mm
  const Obstacles obstacles(scene.triangles);
  for (const RobotSpec& spec : {box_robot(0.2, 0.2), round_robot()}) {
    Robot robot(obstacles, spec);
    ASSERT_EQ(robot.put({-2, 0, 0}, 0, 0), Start::kStands);
    drive(robot, steady(1.0, 0, 0, 4.0));
    EXPECT_NEAR(robot.pose().t.x(), 2.0, 1e-9);
    EXPECT_NEAR(robot.pose().t.y(), 0.0, 1e-9);
    EXPECT_EQ(robot.counts().contacts, 0u);
  }
}

TEST(Slide, NeverJittersBackwards) {
  // Into a corner, along walls and through a narrowing wedge: no part leads against the wanted motion by more than
  // the range of contacts, altogether.
  Scene corner;
  corner.room(-3, -3, 1, 1);
  Scene wedge;
  wedge.floor(-5, -5, 5, 5);
  wedge.wall({-2, 0.9}, {3, -0.02});
  wedge.wall({-2, -0.9}, {3, 0.02});
  for (const Scene& scene : {corner, wedge}) {
    const Obstacles obstacles(scene.triangles);
    for (const RobotSpec& spec : {round_robot(), box_robot(), odd_robot()}) {
      for (const double side : {0.0, 0.3, -0.2, 1.0}) {
        Robot robot(obstacles, spec);
        ASSERT_EQ(robot.put({-1.0, 0, 0}, 0, 0), Start::kStands);
        double farthest = -INFINITY;
        for (int i = 0; i < 30; ++i) {
          // Straight on in the world, whichever way the body was turned.
          const Vec3 way = robot.pose().q.conjugate() * Vec3(1.0, side, 0.0);
          drive(robot, steady(way.x(), way.y(), 0, 0.1));
          for (const Part& part : robot.history().parts()) {
            const double along = part.to.t.x() + side * part.to.t.y();
            EXPECT_GE(along, farthest - kContactRange);
            farthest = std::max(farthest, along);
          }
          robot.forget_before(robot.now_ns() + 1);
        }
        EXPECT_LT(robot.counts().parts, 20000u);
      }
    }
  }
}

TEST(Slide, StopsWhereItDoesNotSlide) {
  const Obstacles obstacles(hall().triangles);
  RobotSpec spec = round_robot();
  spec.move.slide = false;
  Robot robot(obstacles, spec);
  ASSERT_EQ(robot.put({0, 0.5, 0}, 0, 0), Start::kStands);
  drive(robot, steady(0.6, 0.8, 0, 3.0));
  EXPECT_NEAR(robot.pose().t.y(), 0.8 - kClearance, 1e-6);
  EXPECT_NEAR(robot.pose().t.x(), 0.75 * 0.3, 1e-3);
  EXPECT_GT(robot.counts().stood_ns, 2 * kSecond);
}

}  // namespace
}  // namespace hallway::contact::test
