// SPDX-License-Identifier: MIT
#include "eval/driven_way.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "base/error.hpp"
#include "unit/eval/wall_maps.hpp"

namespace hallway::eval {
namespace {

TEST(DrivenWay, ReversesAreSubtractedAndTurnsAddNothing) {
  test::Drive drive(0, 0, 170);
  drive.forward(2).forward(-0.5).turn(90).turn(90).forward(1);
  const DrivenWay way = drive.way();
  EXPECT_NEAR(way.poses().back().way_m, 2.5, 1e-12);
}

TEST(DrivenWay, PosesBetweenTwoAreInterpolated) {
  DrivenWay way;
  way.add(0, {0, 0, 3.1});
  way.add(100, {1, 2, -3.1});
  const auto middle = way.at(50);
  ASSERT_TRUE(middle.has_value());
  EXPECT_NEAR(middle->pose.x_m, 0.5, 1e-12);
  EXPECT_NEAR(middle->forward().x(), -1.0, 1e-12) << "the short way round";
  EXPECT_EQ(way.at(100)->pose.y_m, 2.0);
  EXPECT_FALSE(way.at(-1).has_value());
  EXPECT_FALSE(way.at(101).has_value());
  EXPECT_THROW(way.add(100, {}), Error);
}

TEST(DrivenWay, BodyAndWorldAreInverse) {
  const WayPose pose{0, {3, -2, 0.7}, 0};
  const Vec2 point(1.5, -0.4);
  EXPECT_LT((pose.body(pose.world(point)) - point).norm(), 1e-12);
  EXPECT_LT((pose.world({0, -1}) - pose.place() - pose.right()).norm(), 1e-12);
  EXPECT_NEAR(planar_part(pose.pose.level()).yaw_rad, 0.7, 1e-12);
}

TEST(DrivenWay, PassesAreThoseOfTheSameSideAndHeading) {
  // Around a square of 4 m, clockwise, one and a half times; the place is to the right in the middle of the first side, then the way leads
  // back along that side, with the place on the left.
  test::Drive drive(0, 0, 0);
  for (int side = 0; side < 5; ++side) drive.forward(4).right();
  const DrivenWay way = drive.way();
  const std::vector<double> passes = way.passes(way.poses()[100].t_ns, {0, -0.5}, 0.75);
  ASSERT_EQ(passes.size(), 2u);
  EXPECT_NEAR(passes[0], 2.0, 1e-9);
  EXPECT_NEAR(passes[1], 18.0, 1e-9);
  drive.turn(-90).forward(4);
  EXPECT_EQ(drive.way().passes(way.poses()[100].t_ns, {0, -0.5}, 0.75).size(), 2u);
}

TEST(DrivenWay, WayAbreastOfAPoint) {
  test::Drive drive(0, 0, 0);
  drive.forward(3);
  const DrivenWay way = drive.way();
  EXPECT_NEAR(way.way_abreast({1.234, -1}, 10), 1.234, 1e-12);
  EXPECT_NEAR(way.way_abreast({1.234, -1}, 140), 1.234, 1e-12);
  EXPECT_NEAR(way.way_abreast({9, -1}, 140), 2.8, 1e-12);
}

}  // namespace
}  // namespace hallway::eval
