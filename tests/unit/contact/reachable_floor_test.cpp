// SPDX-License-Identifier: MIT
// The floor that a robot can reach: areas of generated floors, rooms, and that joined neighbours can be driven.
#include "contact/reachable_floor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/long_mode.hpp"
#include "unit/contact/scene.hpp"

namespace hallway::contact::test {
namespace {

ReachableFloor floor_of(const Obstacles& obstacles, const RobotSpec& spec, const Vec3& at, double yaw = 0.3) {
  return {obstacles, spec, {from_yaw_pitch_roll(yaw, 0, 0), at}};
}

/// On a floor that is uneven the height of a stance depends on its heading, metres.
constexpr double kSameFloor = 0.03;

/// Rooms to the west and to the east of x = 0, 6 x 6 m each, and a door of a width in the wall between.
Scene two_rooms(double door) {
  Scene scene;
  scene.room(-6, -3, 6, 3);
  scene.wall({0, -3}, {0, -0.5 * door});
  scene.wall({0, 0.5 * door}, {0, 3});
  return scene;
}

bool reaches(const ReachableFloor& floor, const Vec3& at) {
  return floor.cell_at(at).has_value();
}

/// Drives from each of some random nodes to its neighbours and back, with a heading that both have, and expects to arrive without a contact.
void expect_joined_can_be_driven(const Obstacles& obstacles, const RobotSpec& spec,
                                 const ReachableFloor& floor, std::uint64_t seed, int samples) {
  ASSERT_FALSE(floor.nodes().empty());
  Dice dice(seed);
  int driven = 0;
  for (int i = 0; i < samples; ++i) {
    const FloorNode& a =
        floor.nodes()[static_cast<std::size_t>(dice.below(static_cast<int>(floor.nodes().size())))];
    const int way = dice.below(8);
    if (a.next[static_cast<std::size_t>(way)] == kNoFloorNode) continue;
    const FloorNode& b = floor.nodes()[a.next[static_cast<std::size_t>(way)]];
    bool any = false;
    for (const int heading : {way, (way + 4) & 7}) {
      if (!((a.headings & b.headings) >> heading & 1)) continue;
      Robot robot(obstacles, spec);
      if (robot.put(a.at() + Vec3(0, 0, 0.02), heading * std::numbers::pi / 4.0, 0) != Start::kStands)
        continue;
      if (std::abs(robot.pose().t.z() - a.z) > kSameFloor) continue;
      bool there = false;
      for (const FloorNode* goal : {&b, &a}) {
        // In some steps: on a slope the way is longer than it is seen from above.
        for (int step = 0; step < 8; ++step) {
          const Vec2 left = goal->at().head<2>() - robot.pose().t.head<2>();
          const Vec2 ahead = (robot.pose().q * Vec3::UnitX()).head<2>();
          const double length = left.dot(ahead) / ahead.squaredNorm();
          if (std::abs(length) < 1e-6) break;
          drive(robot, steady(std::copysign(0.25, length), 0, 0, std::abs(length) / 0.25));
        }
        there = (robot.pose().t - goal->at()).head<2>().norm() < 1e-3 &&
                std::abs(robot.pose().t.z() - goal->z) < kSameFloor;
        if (!there) break;
      }
      any = any || (there && robot.counts().contacts == 0);
    }
    EXPECT_TRUE(any) << a.at().transpose() << " to " << b.at().transpose();
    ++driven;
  }
  EXPECT_GT(driven, samples / 4);
}

TEST(ReachableFloor, AnEmptyRoomHasItsArea) {
  Scene scene;
  scene.room(-3, -2, 3, 2);
  const Obstacles obstacles(scene.triangles);
  const ReachableFloor floor = floor_of(obstacles, round_robot(), {0.2, 0.1, 0});
  // The middle of a disc of 0.2 m: |x| < 2.8, |y| < 1.8. The outermost nodes are 2.6875 + 0.0625 from the middle.
  EXPECT_EQ(floor.nodes().size(), 44u * 28u);
  EXPECT_EQ(floor.n_cells(), 12u * 8u);
  for (const FloorNode& node : floor.nodes()) {
    EXPECT_EQ(node.headings, 0xff);
    EXPECT_EQ(node.z, 0.0);
    EXPECT_TRUE(floor.cell_at(node.at()));
  }
  EXPECT_FALSE(floor.is_cut_off());
  EXPECT_FALSE(reaches(floor, {4, 0, 0}));
  EXPECT_FALSE(reaches(floor, {0, 0, 1}));
  EXPECT_EQ(floor.n_rooms(), 1u);
  EXPECT_TRUE(floor.room_at({0, 0, 0}));
  EXPECT_FALSE(floor.room_at({2.7, 0, 0}));
}

TEST(ReachableFloor, TheStartDoesNotMatter) {
  const Obstacles obstacles(two_rooms(0.9).triangles);
  const ReachableFloor a = floor_of(obstacles, box_robot(), {-3, 1, 0}),
                       b = floor_of(obstacles, box_robot(), {4, -2, 0}, 2.0);
  ASSERT_EQ(a.nodes().size(), b.nodes().size());
  EXPECT_EQ(a.n_cells(), b.n_cells());
  for (const FloorNode& node : a.nodes()) EXPECT_EQ(a.cell_at(node.at()), b.cell_at(node.at()));
}

TEST(ReachableFloor, ADoorMustBeWiderThanTheBody) {
  for (const auto& [door, is_through] : {std::pair(0.65, true), std::pair(0.39, false)}) {
    const Obstacles obstacles(two_rooms(door).triangles);
    const ReachableFloor floor = floor_of(obstacles, round_robot(), {-3, 0, 0});
    EXPECT_EQ(reaches(floor, {3, 0, 0}), is_through) << door;
    EXPECT_EQ(floor.n_rooms(), is_through ? 2u : 1u);
  }
  // A box of 0.4 x 0.3 m goes ahead through a door through which it could not go sideways.
  const Obstacles obstacles(two_rooms(0.44).triangles);
  EXPECT_TRUE(reaches(floor_of(obstacles, box_robot(0.3, 0.15), {-3, 0, 0}), {3, 0, 0}));
  EXPECT_FALSE(reaches(floor_of(obstacles, box_robot(0.3, 0.23), {-3, 0, 0}), {3, 0, 0}));
}

TEST(ReachableFloor, LedgesEndIt) {
  Scene scene;
  scene.floor(-2, -2, 2, 2, 1.0);
  scene.floor(-6, -6, 6, 6, 0.0);
  const Obstacles obstacles(scene.triangles);
  const ReachableFloor floor = floor_of(obstacles, round_robot(), {0, 0, 1});
  // Wheels at up to 0.1 m from the origin.
  EXPECT_NEAR(floor.area_m2(), 3.8 * 3.8, 0.8);
  for (const FloorNode& node : floor.nodes()) EXPECT_EQ(node.z, 1.0);
}

TEST(ReachableFloor, RampsWithinTheSlope) {
  for (const double slope : {0.25, 0.45}) {
    Scene scene;
    const double top = 2.0 * std::tan(slope);
    scene.floor(-4, -3, 0, 3);
    scene.ramp(0, 2, 0, top);
    scene.floor(2, -3, 6, 3, top);
    const Obstacles obstacles(scene.triangles);
    const RobotSpec spec = round_robot();
    const ReachableFloor floor = floor_of(obstacles, spec, {-2, 0, 0});
    EXPECT_EQ(reaches(floor, {4, 0, top}), slope < spec.ground.slope_rad) << slope;
    EXPECT_TRUE(reaches(floor, {-3, 0, 0}));
  }
}

TEST(ReachableFloor, StepsWithinTheLimit) {
  for (const double step : {0.015, 0.025}) {
    Scene scene;
    scene.floor(-4, -3, 0, 3);
    scene.ramp(0, 0, 0, step);
    scene.floor(0, -3, 4, 3, step);
    const Obstacles obstacles(scene.triangles);
    const ReachableFloor floor = floor_of(obstacles, round_robot(), {-2, 0, 0});
    EXPECT_EQ(reaches(floor, {2, 0, step}), step < 0.02) << step;
  }
}

TEST(ReachableFloor, StoreysOverEachOther) {
  Scene scene;
  scene.floor(-4, -3, 6, 3);
  scene.ramp(6, 10, 0, 1.2);
  scene.floor(10, -3, 12, 3, 1.2);
  // Back over the lower floor, beside the ramp.
  scene.quad({10, 3, 1.2}, {12, 3, 1.2}, {12, 5, 1.2}, {10, 5, 1.2});
  scene.floor(0, 3, 10, 5, 1.2);
  scene.floor(-4, 1, 0, 5, 1.2);
  const Obstacles obstacles(scene.triangles);
  const ReachableFloor floor = floor_of(obstacles, round_robot(), {-2, -1, 0});
  const auto low = floor.cell_at({-2, 2, 0}), high = floor.cell_at({-2, 2, 1.2});
  ASSERT_TRUE(low && high);
  EXPECT_NE(*low, *high);
  EXPECT_FALSE(floor.cell_at({-2, 2, 0.6}));
}

TEST(ReachableFloor, JoinedNeighboursCanBeDriven) {
  Scene scene;
  scene.room(-5, -4, 5, 4);
  Dice dice(3);
  for (int i = 0; i < 25; ++i)
    scene.box({dice.in(-4, 4), dice.in(-3, 3)}, dice.in(0.1, 0.5), 0.2, 0.0, 1.0, dice.in(0, 3));
  scene.box({-4.0, 3.2}, 0.8, 0.8, 0.0, 0.015, 0.4);  // a plate that wheels climb
  const Obstacles obstacles(scene.triangles);
  for (const RobotSpec& spec : {round_robot(), box_robot(), odd_robot()}) {
    std::optional<FreeStart> start =
        find_free_start(obstacles, spec, Box(Vec3(-5, -4, 0.1), Vec3(5, 4, 0.2)), {}, 5);
    ASSERT_TRUE(start);
    expect_joined_can_be_driven(obstacles, spec, start->floor, 7, hallway::test::sized(150, 3000));
  }
}

TEST(ReachableFloor, JoinedNeighboursOnRampsAndStepsCanBeDriven) {
  Scene scene;
  scene.floor(-4, -3, 0, 3);
  scene.ramp(0, 3, 0, 0.8);
  scene.floor(3, -3, 5, 3, 0.8);
  scene.floor(5, -3, 7, 3, 0.815);
  scene.wall({1, -1}, {2, 1}, 0.0, 3.0);
  const Obstacles obstacles(scene.triangles);
  for (const RobotSpec& spec : {round_robot(), box_robot()}) {
    const ReachableFloor floor = floor_of(obstacles, spec, {-2, 0, 0});
    EXPECT_TRUE(reaches(floor, {6, 0, 0.815}));
    expect_joined_can_be_driven(obstacles, spec, floor, 9, hallway::test::sized(150, 3000));
  }
}

TEST(ReachableFloor, FreePlacesAreUniformAndFree) {
  const Obstacles obstacles(two_rooms(0.9).triangles);
  const RobotSpec spec = box_robot();
  const ReachableFloor floor = floor_of(obstacles, spec, {-3, 0, 0});
  Robot robot(obstacles, spec);
  int west = 0;
  constexpr int kPlaces = 1000;
  for (std::uint32_t i = 0; i < kPlaces; ++i) {
    const auto place = floor.free_place(4, i);
    ASSERT_TRUE(place);
    EXPECT_EQ(robot.put(place->position, place->yaw_rad, 0), Start::kStands);
    west += place->position.x() < 0.0;
  }
  EXPECT_NEAR(west, 0.5 * kPlaces, 3.0 * std::sqrt(0.25 * kPlaces));
  EXPECT_EQ(floor.free_place(4, 1)->position, floor.free_place(4, 1)->position);
  EXPECT_NE(floor.free_place(4, 1)->position, floor.free_place(5, 1)->position);
}

TEST(ReachableFloor, FreeStartIsOnTheLargestFloor) {
  Scene scene;
  scene.room(-4, -4, 4, 4);
  scene.box({3, 3}, 1.8, 1.8, 0.0, 1.0);  // a cupboard, on which the robot can drive
  scene.room(-3.9, -3.9, -2.9, -2.9);     // a niche
  const Obstacles obstacles(scene.triangles);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto start =
        find_free_start(obstacles, round_robot(), Box(Vec3(-4, -4, 0.1), Vec3(4, 4, 2)), {}, seed);
    ASSERT_TRUE(start);
    EXPECT_LT(start->place.position.z(), 0.01);
    EXPECT_GT(start->floor.area_m2(), 20.0);
  }
}

TEST(ReachableFloor, IsEmptyWhereTheRobotCannotStand) {
  const Obstacles obstacles(two_rooms(0.9).triangles);
  const ReachableFloor floor = floor_of(obstacles, round_robot(), {0.05, 2, 0});
  EXPECT_EQ(floor.n_cells(), 0u);
  EXPECT_EQ(floor.n_rooms(), 0u);
  EXPECT_FALSE(floor.free_place(1, 0));
}

}  // namespace
}  // namespace hallway::contact::test
