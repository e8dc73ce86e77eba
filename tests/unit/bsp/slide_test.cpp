// SPDX-License-Identifier: MIT
#include "bsp/slide.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "body_points.hpp"
#include "query_worlds.hpp"
#include "support/errors.hpp"
#include "support/long_mode.hpp"

namespace hallway {
namespace {

using bsp::kClearance;
using bsp::SlideResult;
using test::QueryWorld;

SlideResult slide(const QueryWorld& world, const Vec3& from, const Vec3& to, const bsp::Body& body,
                  const bsp::SlideOptions& options = {}) {
  return bsp::slide(world.compiled.tree, world.compiled.surface, from, to, body, options);
}

TEST(Slide, NeverEndsInSolidNorGainsDistance) {
  for (const QueryWorld& world : test::made_worlds()) {
    const Random random(11, stream_id("slides"));
    const Box& box = world.world.bounds;
    std::size_t slid = 0;
    for (std::uint32_t i = 0; i < test::sized(1500u, 50000u); ++i) {
      Vec3 from, motion;
      for (int k = 0; k < 3; ++k) {
        from[k] = random.uniform(i, static_cast<std::uint64_t>(k), box.min()[k], box.max()[k]);
        motion[k] = random.uniform(i, 3 + static_cast<std::uint64_t>(k), -8, 8);
      }
      const bsp::Body body = test::random_body(random, i);
      const bsp::SlideOptions options{.step_m = i % 4 == 0 ? 0.2 : 0.0};
      const SlideResult result = slide(world, from, from + motion, body, options);
      if (result.starts_in_solid) {
        ASSERT_EQ(result.position, from);
        continue;
      }
      ASSERT_FALSE(test::reaches_solid(world.compiled.tree, body, result.position)) << world.name << " " << i;
      if (options.step_m == 0.0) {
        const Vec3 way = result.position - from;
        ASSERT_LE(way.norm(), motion.norm() + 1e-5) << i;
        ASSERT_GE(way.dot(motion), -1e-4) << i;
      }
      const SlideResult again = slide(world, from, from + motion, body, options);
      ASSERT_EQ(again.position, result.position);
      ASSERT_EQ(again.contacts.size(), result.contacts.size());
      if (!result.contacts.empty() && (result.position - from).norm() > 0.1) ++slid;
    }
    EXPECT_GT(slid, 200u) << world.name;
  }
}

class SlideInRooms : public testing::Test {
 protected:
  static const QueryWorld& world() {
    static const QueryWorld rooms = test::make_query_world("rooms", test::rooms(), {{1, 6, 1}});
    return rooms;
  }
  const bsp::Body robot = bsp::Cylinder{0.25, 0.0, 1.0};
};

TEST_F(SlideInRooms, AlongAWall) {
  const SlideResult result = slide(world(), {9, 7, 0}, {11, 9, 0}, robot);
  ASSERT_EQ(result.contacts.size(), 1u);
  EXPECT_NEAR((result.position - Vec3(9.75, 9, 0)).norm(), 0.0, 1e-5);
}

TEST_F(SlideInRooms, StopsInACorner) {
  const SlideResult result = slide(world(), {9, 11, 0}, {12, 14, 0}, robot);
  EXPECT_EQ(result.contacts.size(), 2u);
  EXPECT_NEAR((result.position - Vec3(9.75, 11.75, 0)).norm(), 0.0, 1e-5);
  const SlideResult again = slide(world(), result.position, {12, 14, 0}, robot);
  EXPECT_NEAR((again.position - result.position).norm(), 0.0, 1e-5);
}

TEST_F(SlideInRooms, BetweenTwoFacesAlongTheirCrease) {
  // Down and sideways into the crease of floor and wall: only the motion along it is left.
  for (const bsp::Body& body : {bsp::Body(bsp::Sphere{0.25}), robot}) {
    const double height = std::holds_alternative<bsp::Sphere>(body) ? 0.25 : 0.0;
    const SlideResult result = slide(world(), {9.5, 7, height + 0.1}, {10.5, 9, height - 1}, body);
    EXPECT_NEAR((result.position - Vec3(9.75, 9, height)).norm(), 0.0, 1e-5);
  }
}

TEST_F(SlideInRooms, UpARamp) {
  const SlideResult result = slide(world(), {11.5, 2.5, 0.25}, {15, 2.5, 0.25}, bsp::Sphere{0.25});
  ASSERT_FALSE(result.contacts.empty());
  EXPECT_GT(result.position.z(), 0.8);
  EXPECT_NEAR(result.position.y(), 2.5, 1e-6);
}

TEST_F(SlideInRooms, ClimbsStepsIfItMay) {
  const bsp::Body body = bsp::UprightBox{0.2, 0.2, 0.0, 0.0, 1.0};
  Vec3 place(0.5, 9, 0);
  for (int i = 0; i < 25; ++i)
    place = slide(world(), place, place + Vec3(0.1, 0, 0), body, {.step_m = 0.15}).position;
  EXPECT_NEAR((place - Vec3(3, 9, 0.5)).norm(), 0.0, 1e-4);
  const SlideResult low = slide(world(), {0.5, 9, 0}, {3, 9, 0}, body, {.step_m = 0.1});
  EXPECT_NEAR(low.position.x(), 0.8, 1e-5);
  EXPECT_NEAR(low.position.z(), 0.0, 1e-5);
  EXPECT_NEAR(slide(world(), {0.5, 9, 0}, {3, 9, 0}, body).position.x(), 0.8, 1e-5);
}

TEST_F(SlideInRooms, StopsAtTheLastContactItMayHave) {
  EXPECT_EQ(slide(world(), {9, 11, 0}, {12, 14, 0}, robot, {.most_contacts = 1}).contacts.size(), 1u);
}

TEST_F(SlideInRooms, RefusesNonsense) {
  for (const double step : {-0.1, std::nan("")}) {
    EXPECT_TRUE(test::error_of([&] { slide(world(), {9, 7, 0}, {9, 8, 0}, robot, {.step_m = step}); }));
  }
  EXPECT_TRUE(slide(world(), {10.25, 9, 1}, {9, 8, 0}, robot).starts_in_solid);
}

}  // namespace
}  // namespace hallway
