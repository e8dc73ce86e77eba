// SPDX-License-Identifier: MIT
#include "bsp/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "body_points.hpp"
#include "bsp/contact.hpp"
#include "query_worlds.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"

namespace hallway {
namespace {

using bsp::kClearance;
using bsp::sweep_body;
using bsp::SweepResult;
using test::QueryWorld;

/// The way of a body in a world, and the body.
struct Trial {
  bsp::Body body;
  Vec3 from, to;
};

Trial trial(const QueryWorld& world, std::uint32_t number) {
  const Random random(8, stream_id("sweeps"));
  const auto place = [&](std::uint64_t n) {
    Vec3 point;
    for (int k = 0; k < 3; ++k)
      point[k] = random.uniform(number, n + static_cast<std::uint64_t>(k), world.world.bounds.min()[k],
                                world.world.bounds.max()[k]);
    return point;
  };
  const bsp::Tree& tree = world.compiled.tree;
  Trial result{test::random_body(random, number), place(0), place(3)};
  for (std::uint64_t i = 2;
       i < 60 && tree.leaves[bsp::leaf_at(tree, result.from)].content == bsp::Content::kSolid; ++i)
    result.from = place(3 * i);
  const double share = random.uniform(number, 400);
  if (number % 2 == 0) result.to = result.from + share * share * (result.to - result.from);
  if (number % 5 == 0) result.to.z() = result.from.z();
  return result;
}

/// The first contact by all polygons of the surface, and how far the body then comes.
std::pair<double, std::optional<bsp::BodyContact>> all_polygons(const QueryWorld& world, const Trial& t) {
  const csg::Surface& surface = world.compiled.surface;
  const Vec3 motion = t.to - t.from;
  const bsp::BodyShape shape = shape_of(t.body, 0.5 * kClearance);
  double first = 1.0;
  std::optional<bsp::BodyContact> contact;
  bsp::NearFace face;
  for (std::uint32_t i = 0; i < surface.polygons.size(); ++i) {
    if (surface.polygons[i].plane.normal.dot(motion) >= 0.0 ||
        !load(surface, surface.polygons[i], t.from, face))
      continue;
    const auto touch = first_touch(shape, face, motion, 1.0);
    if (!touch || (contact && touch->fraction >= first)) continue;
    first = touch->fraction;
    contact = bsp::BodyContact{touch->normal, i};
  }
  if (contact) first = std::max(0.0, first - 0.5 * kClearance / -contact->normal.dot(motion));
  return {first, contact};
}

void check_against_all_polygons(const QueryWorld& world, const Trial& t, const SweepResult& result) {
  const auto [fraction, contact] = all_polygons(world, t);
  ASSERT_EQ(result.fraction, fraction);
  ASSERT_EQ(result.contact.has_value(), contact.has_value());
  if (!contact) return;
  ASSERT_EQ(result.contact->polygon, contact->polygon);
  ASSERT_EQ(result.contact->normal, contact->normal);
  ASSERT_LT(contact->normal.dot(t.to - t.from), 0.0);
}

void check_random_sweeps(const QueryWorld& world, std::uint32_t count) {
  const bsp::Tree& tree = world.compiled.tree;
  std::size_t free = 0, stopped = 0, in_solid = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Trial t = trial(world, i);
    const SweepResult result = sweep_body(tree, world.compiled.surface, t.from, t.to, t.body);
    if (result.starts_in_solid) {
      ++in_solid;
      ASSERT_EQ(result.position, t.from);
      ASSERT_EQ(result.fraction, 0.0);
      continue;
    }
    ASSERT_FALSE(test::reaches_solid(tree, t.body, t.from)) << i;
    ASSERT_FALSE(test::reaches_solid(tree, t.body, result.position)) << i;
    for (const double share : {0.3, 0.7}) {
      ASSERT_FALSE(test::reaches_solid(tree, t.body, t.from + share * (result.position - t.from))) << i;
    }
    ASSERT_NO_FATAL_FAILURE(check_against_all_polygons(world, t, result)) << world.name << " " << i;
    ++(result.contact ? stopped : free);
  }
  std::printf("%s: %zu came through, %zu were stopped, %zu started in solid\n", world.name.c_str(), free,
              stopped, in_solid);
  EXPECT_GT(free, count / 50);
  EXPECT_GT(stopped, count / 10);
}

TEST(Sweep, AgreesWithAllPolygonsOfMadeWorlds) {
  for (const QueryWorld& world : test::made_worlds()) check_random_sweeps(world, test::sized(3000u, 100000u));
}

TEST(Sweep, AgreesWithAllPolygonsOfARealMap) {
  HALLWAY_DATA_OR_SKIP(path, "maps/id1/e1m1.map");
  check_random_sweeps(test::load_query_world(path), test::sized(300u, 20000u));
}

class SweepInRooms : public testing::Test {
 protected:
  static const QueryWorld& world() {
    static const QueryWorld rooms = test::make_query_world("rooms", test::rooms(), {{1, 6, 1}});
    return rooms;
  }
  static SweepResult sweep(const Vec3& from, const Vec3& to, const bsp::Body& body) {
    return sweep_body(world().compiled.tree, world().compiled.surface, from, to, body);
  }
  static std::vector<bsp::Body> bodies() {
    return {bsp::Sphere{0.25}, bsp::Cylinder{0.25, -0.25, 0.25},
            bsp::UprightBox{0.25, 0.25, 0.0, -0.25, 0.25}};
  }
  const bsp::Body robot = bsp::Cylinder{0.3, 0.0, 1.0};
};

TEST_F(SweepInRooms, StopsBeforeAWall) {
  for (const bsp::Body& body : bodies()) {
    const SweepResult result = sweep({8, 7, 1}, {12, 7, 1}, body);
    ASSERT_TRUE(result.contact);
    EXPECT_NEAR(result.position.x(), 10.0 - 0.25 - kClearance, 1e-12);
    EXPECT_NEAR(result.fraction, 1.75 / 4, 1e-6);
    EXPECT_NEAR((result.contact->normal - Vec3(-1, 0, 0)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(world().compiled.surface.polygons[result.contact->polygon].plane.offset, -10.0, 1e-12);
    EXPECT_FALSE(result.starts_in_contact);
    const SweepResult again = sweep(result.position, {12, 7, 1}, body);
    EXPECT_TRUE(again.starts_in_contact);
    EXPECT_NEAR((again.position - result.position).norm(), 0.0, 1e-12);
    EXPECT_EQ(sweep(result.position, {8, 7, 1}, body).fraction, 1.0);                     // back
    EXPECT_EQ(sweep(result.position, {result.position.x(), 11, 1}, body).fraction, 1.0);  // along
  }
}

TEST_F(SweepInRooms, ARobotDrivesOnTheFloorThroughTheDoor) {
  // It stands on the floor: z is exactly that of the floor.
  const SweepResult result = sweep({6, 5.5, 0}, {14, 5.5, 0}, robot);
  EXPECT_FALSE(result.starts_in_solid);
  EXPECT_TRUE(result.starts_in_contact);
  EXPECT_FALSE(result.contact);
  EXPECT_LE((result.position - Vec3(14, 5.5, 0)).norm(), 2 * kClearance);
  EXPECT_TRUE(sweep({6, 5.25, 0}, {14, 5.25, 0}, robot).contact);  // its side does not pass
}

TEST_F(SweepInRooms, WhatIsAsWideAsTheDoorDoesNotPass) {
  EXPECT_TRUE(sweep({6, 5.5, 1}, {14, 5.5, 1}, bsp::UprightBox{0.3, 0.5, 0, -0.5, 0.5}).contact);
  EXPECT_FALSE(sweep({6, 5.5, 1}, {14, 5.5, 1}, bsp::UprightBox{0.3, 0.5 - 1e-6, 0, -0.5, 0.5}).contact);
  EXPECT_FALSE(sweep({6, 5.5, 1}, {14, 5.5, 1}, bsp::Sphere{0.5 - 1e-6}).contact);
}

TEST_F(SweepInRooms, EdgesAndCornersStopToo) {
  // The upright edge of the pillar at (4, 4): a ball in the level 0.2 beside it, from afar.
  const SweepResult result = sweep({2, 3.8, 2}, {8, 3.8, 2}, bsp::Sphere{0.25});
  ASSERT_TRUE(result.contact);
  EXPECT_NEAR((Vec2(result.position.x(), result.position.y()) - Vec2(4, 4)).norm(), 0.25 + kClearance, 1e-9);
  EXPECT_NEAR(result.contact->normal.y(), -0.8, 1e-5);
  const SweepResult round = sweep({2, 3.8, 2}, {8, 3.8, 2}, bsp::Cylinder{0.25, -1, 1});
  ASSERT_TRUE(round.contact);
  EXPECT_NEAR((Vec2(round.position.x(), round.position.y()) - Vec2(4, 4)).norm(), 0.25,
              0.0022 * 0.25 + kClearance);
  EXPECT_FALSE(sweep({2, 3.7, 2}, {3.9, 3.7, 2}, bsp::Sphere{0.25}).contact);
}

TEST_F(SweepInRooms, SinksNoDeeperThanItStarts) {
  for (const double depth : {0.0, 0.5e-6, 0.9e-6}) {
    for (const bsp::Body& body : bodies()) {
      const SweepResult result = sweep({5, 6, 0.25 - depth}, {5, 6, -3}, body);
      EXPECT_FALSE(result.starts_in_solid);
      EXPECT_NEAR(result.position.z(), 0.25 + kClearance, 1e-8);
      ASSERT_TRUE(result.contact);
      EXPECT_NEAR(result.contact->normal.z(), 1.0, 1e-12);
    }
  }
  for (const bsp::Body& body : bodies()) {
    const SweepResult result = sweep({5, 6, 0.25 - 3e-6}, {5, 6, 3}, body);
    EXPECT_TRUE(result.starts_in_solid);
    EXPECT_EQ(result.position, Vec3(5, 6, 0.25 - 3e-6));
  }
  EXPECT_TRUE(sweep({-0.5, 6, 1}, {5, 6, 1}, bsp::Sphere{0.1}).starts_in_solid);  // wholly in the wall
  EXPECT_TRUE(sweep({100, 6, 1}, {5, 6, 1}, bsp::Sphere{0.1}).starts_in_solid);   // beyond the sealed world
}

TEST_F(SweepInRooms, ManyTinyMovesComeAsFarAsOne) {
  for (const bsp::Body& body : bodies()) {
    const Vec3 step(1e-4, -2e-5, 0);
    Vec3 place(9.6, 7, 1);
    for (int i = 0; i < 3000; ++i) place = sweep(place, place + step, body).position;
    const SweepResult once = sweep({9.6, 7, 1}, Vec3(9.6, 7, 1) + 3000 * step, body);
    EXPECT_NEAR((place - once.position).norm(), 0.0, 1e-5);
    EXPECT_FALSE(test::reaches_solid(world().compiled.tree, body, place));
  }
}

TEST_F(SweepInRooms, RefusesNonsense) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  const bsp::Body bad[] = {bsp::Sphere{0.0},
                           bsp::Sphere{nan},
                           bsp::Sphere{-1},
                           bsp::Sphere{infinity},
                           bsp::Cylinder{0.3, 1.0, 1.0},
                           bsp::Cylinder{0.3, 1.0, 0.0},
                           bsp::Cylinder{nan, 0, 1},
                           bsp::Cylinder{0.3, nan, 1},
                           bsp::UprightBox{0.3, 0.0, 0, 0, 1},
                           bsp::UprightBox{0.3, 0.3, nan, 0, 1},
                           bsp::UprightBox{0.3, 0.3, 0, 0, infinity}};
  for (const bsp::Body& body : bad) {
    const auto error = test::error_of([&] { sweep({5, 6, 1}, {6, 6, 1}, body); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  }
  for (const double value : {nan, infinity, 1e9}) {
    EXPECT_TRUE(test::error_of([&] { sweep({5, value, 1}, {6, 6, 1}, robot); }));
    EXPECT_TRUE(test::error_of([&] { sweep({5, 6, 1}, {6, 6, value}, robot); }));
  }
  const SweepResult still = sweep({5, 6, 1}, {5, 6, 1}, robot);
  EXPECT_EQ(still.position, Vec3(5, 6, 1));
  EXPECT_EQ(still.fraction, 1.0);
}

/// A pit in the floor: what stands on the floor passes over a gap that is too narrow for it, whatever the gap's walls.
TEST(Sweep, EdgesInTheFloorStopNothingThatStandsOnIt) {
  test::WorldMaker maker;
  maker.box({-5, -5, -1}, {0, 5, 0}).box({0.05, -5, -1}, {5, 5, 0}).box({0, -5, -1}, {0.05, 5, -0.5});
  const QueryWorld world = test::make_query_world("pit", maker.world(), {});
  for (const double height : {0.0, kClearance, -0.5e-6}) {
    for (const bsp::Body& body :
         {bsp::Body(bsp::Cylinder{0.3, 0, 1}), bsp::Body(bsp::UprightBox{0.3, 0.2, 0.4, 0, 1})}) {
      EXPECT_FALSE(
          sweep_body(world.compiled.tree, world.compiled.surface, {-3, 0.2, height}, {3, 1, height}, body)
              .contact);
    }
  }
}

TEST(Sweep, FromFarAway) {
  test::WorldMaker maker;
  const QueryWorld world = test::make_query_world("box", maker.box({-1, -1, -1}, {1, 1, 1}).world(), {});
  for (const double far : {1e3, 1e6}) {
    const SweepResult result =
        sweep_sphere(world.compiled.tree, world.compiled.surface, {-far, 0.1, 0.2}, {far, 0.1, 0.2}, 0.5);
    ASSERT_TRUE(result.contact);
    EXPECT_NEAR(result.position.x(), -1.5 - kClearance, 1e-8);
  }
}

TEST(Sweep, InAnEmptyWorld) {
  bsp::Tree tree;
  tree.leaves.resize(1);
  const csg::Surface surface;
  EXPECT_EQ(sweep_sphere(tree, surface, {0, 0, 0}, {1, 0, 0}, 0.5).fraction, 1.0);
  tree.leaves[0].content = bsp::Content::kSolid;
  EXPECT_TRUE(sweep_sphere(tree, surface, {0, 0, 0}, {1, 0, 0}, 0.5).starts_in_solid);
}

}  // namespace
}  // namespace hallway
