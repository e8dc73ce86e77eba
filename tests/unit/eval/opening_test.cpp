// SPDX-License-Identifier: MIT
#include "eval/opening.hpp"

#include <gtest/gtest.h>

#include "unit/eval/wall_maps.hpp"

namespace hallway::eval {
namespace {

using test::Boundary;

/// The wall that ends at a corner.
std::size_t wall_to(const FloorPlan& plan, const Vec2& corner) {
  for (std::size_t i = 0; i < plan.walls().size(); ++i) {
    if (plan.walls()[i].end() == corner) return i;
  }
  ADD_FAILURE() << "no wall ends there";
  return 0;
}

std::optional<Opening> opening_at(const FloorPlan& plan, const Vec2& corner) {
  return find_opening(plan, wall_to(plan, corner), 4.0, 0.5);
}

TEST(Opening, FarSideIsTheWallInLine) {
  const FloorPlan plan = test::plan_of(test::doorway_hall());
  const auto door = opening_at(plan, {3, 0});
  ASSERT_TRUE(door.has_value());
  EXPECT_EQ(door->to, Vec2(4, 0));
  EXPECT_DOUBLE_EQ(door->width_m(), 1.0);
  // Out of the hallway that ends, the other wall is ahead.
  const auto out = opening_at(plan, {8.5, 0});
  ASSERT_TRUE(out.has_value());
  EXPECT_LT((out->to - Vec2(8.5, 2)).norm(), 1e-12);
  EXPECT_FALSE(find_opening(plan, wall_to(plan, {8.5, 0}), 1.9, 0.5).has_value());
}

TEST(Opening, FarSideMayBeBesideTheLine) {
  for (const double aside : {-0.3, 0.3}) {
    const FloorPlan plan =
        test::plan_of({{{0, 0}, {2, 0}, {2, -3}, {3.5, -3}, {3.5, aside}, {9, aside}, {9, 2}, {0, 2}}});
    const auto found = opening_at(plan, {2, 0});
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->to.x(), 3.5, 1e-12);
  }
  const FloorPlan far =
      test::plan_of({{{0, 0}, {2, 0}, {2, -3}, {3.5, -3}, {3.5, -0.7}, {9, -0.7}, {9, 2}, {0, 2}}});
  EXPECT_FALSE(opening_at(far, {2, 0}).has_value());
}

TEST(Opening, SlantedEdgesAreNotTheFarSide) {
  const FloorPlan plan = test::plan_of(
      {{{0, 0}, {2, 0}, {2.3, -0.3}, {2.3, -3}, {3.7, -3}, {3.7, -0.3}, {4, 0}, {9, 0}, {9, 2}, {0, 2}}});
  const auto found = opening_at(plan, {2, 0});
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->to.y(), -0.5, 0.51);
  EXPECT_NEAR(found->to.x(), 3.7, 1e-3);
}

TEST(Opening, SeenShareIsThatOfTheFan) {
  const FloorPlan plan = test::plan_of(test::doorway_hall());
  const std::vector<Vec2> region = region_behind(plan, *opening_at(plan, {3, 0}));
  ASSERT_EQ(region.size(), 8u);
  // From (3.5, 0) the rays past the edges of the doorway (3, -0.2) and (4, -0.2) meet the side walls 0.6 m deep: two triangles of
  // 1 x 0.4 m are hidden, of 3 x 3 + 1 x 0.2 square metres.
  EXPECT_NEAR(polygon_area(region), 9.2, 1e-12);
  EXPECT_NEAR(seen_share(region), (9.2 - 2 * 0.5 * 1 * 0.4) / 9.2, 1e-12);
}

TEST(Opening, RoomsAreClosedAndAboutAsWideAsLong) {
  const FloorPlan plan = test::plan_of(test::doorway_hall());
  EXPECT_EQ(what_is_behind(plan, *opening_at(plan, {3, 0})), Behind::kRoom);
  EXPECT_EQ(what_is_behind(plan, *opening_at(plan, {7, 0})), Behind::kHallway);
  EXPECT_EQ(what_is_behind(plan, *opening_at(plan, {8.5, 0})), Behind::kHallway);
}

TEST(Opening, WideIsARoomWhereAsDeepIsAHallway) {
  const auto behind = [](double wide_m, double deep_m) {
    const FloorPlan plan = test::plan_of({{{0, 0},
                                           {2, 0},
                                           {2, -0.1},
                                           {1, -0.1},
                                           {1, -deep_m},
                                           {1 + wide_m, -deep_m},
                                           {1 + wide_m, -0.1},
                                           {2.9, -0.1},
                                           {2.9, 0},
                                           {9, 0},
                                           {9, 2},
                                           {0, 2}}});
    return what_is_behind(plan, *opening_at(plan, {2, 0}));
  };
  EXPECT_EQ(behind(5.3, 1.8), Behind::kRoom);
  EXPECT_EQ(behind(2.0, 5.3), Behind::kHallway);
  EXPECT_EQ(behind(7.5, 1.8), Behind::kHallway);
  EXPECT_EQ(behind(2.5, 5.3), Behind::kRoom);
}

TEST(Opening, RoomWithASecondDoorIsAHallway) {
  // A room below a hallway, with doorways at 2 to 3 m and at 5 to 6 m: the wall between them stands free.
  const Boundary boundary{{{0, 0},
                           {2, 0},
                           {2, -0.1},
                           {1, -0.1},
                           {1, -5},
                           {7, -5},
                           {7, -0.1},
                           {6, -0.1},
                           {6, 0},
                           {9, 0},
                           {9, 2},
                           {0, 2}},
                          {{3, 0}, {5, 0}, {5, -0.1}, {3, -0.1}}};
  const FloorPlan plan = test::plan_of(boundary);
  const auto door = opening_at(plan, {2, 0});
  ASSERT_TRUE(door.has_value());
  EXPECT_EQ(door->to, Vec2(3, 0));
  EXPECT_TRUE(region_behind(plan, *door).empty());
  EXPECT_EQ(what_is_behind(plan, *door), Behind::kHallway);
}

TEST(Opening, RegionOfWhichLittleIsSeenIsAHallway) {
  // As wide as deep, but a spiral: a first leg of 1 x 5 m, a second one along the bottom and a third one up again.
  const FloorPlan plan = test::plan_of({{{0, 0},
                                         {2, 0},
                                         {2, -5},
                                         {7, -5},
                                         {7, -0.2},
                                         {6, -0.2},
                                         {6, -4},
                                         {3, -4},
                                         {3, 0},
                                         {9, 0},
                                         {9, 2},
                                         {0, 2}}});
  const auto door = opening_at(plan, {2, 0});
  ASSERT_TRUE(door.has_value());
  EXPECT_FALSE(region_behind(plan, *door).empty());
  EXPECT_EQ(what_is_behind(plan, *door), Behind::kHallway);
}

}  // namespace
}  // namespace hallway::eval
