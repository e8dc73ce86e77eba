// SPDX-License-Identifier: MIT
#include "eval/floor_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "unit/eval/wall_maps.hpp"

namespace hallway::eval {
namespace {

TEST(FloorPlan, WallsAreJoinedAtCorners) {
  const FloorPlan plan = test::plan_of(test::niche_room());
  ASSERT_EQ(plan.walls().size(), 8u);
  std::size_t at = 0;
  double length_m = 0.0;
  for (int i = 0; i < 8; ++i) {
    length_m += plan.walls()[at].length_m;
    EXPECT_EQ(plan.walls()[plan.walls()[at].next].start(), plan.walls()[at].end());
    at = plan.walls()[at].next;
  }
  EXPECT_EQ(at, 0u);
  EXPECT_NEAR(length_m, 16.6, 1e-12);
}

TEST(FloorPlan, PiecesOfOneWallAreOne) {
  // Cut in an order that is not that of the way, with a piece of no length.
  const std::vector<PlanSegment> segments{
      {{2, 0}, {3, 0}}, {{0, 0}, {1, 0}}, {{1, 0}, {1, 0}}, {{1, 0}, {2, 0}}};
  const FloorPlan plan(segments);
  ASSERT_EQ(plan.walls().size(), 1u);
  EXPECT_EQ(plan.walls()[0].points.size(), 4u);
  EXPECT_DOUBLE_EQ(plan.walls()[0].length_m, 3.0);
  EXPECT_EQ(plan.walls()[0].next, PlanWall::kNone);
}

TEST(FloorPlan, ArcsHaveNoCorners) {
  std::vector<Vec2> circle;
  for (int i = 0; i < 36; ++i) {
    const double angle = i * std::numbers::pi / 18;
    circle.emplace_back(3 * std::cos(angle), 3 * std::sin(angle));
  }
  const FloorPlan plan = test::plan_of({circle});
  ASSERT_EQ(plan.walls().size(), 1u);
  EXPECT_EQ(plan.walls()[0].next, 0u);
  EXPECT_NEAR(plan.walls()[0].length_m, 36 * 6 * std::sin(std::numbers::pi / 36), 1e-9);
}

TEST(FloorPlan, BoundariesThatTouchStayApart) {
  // Two square pillars in a hall that touch in (0, 0).
  const test::Boundary boundary{{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}},
                                {{0, 0}, {0, 1}, {1, 1}, {1, 0}},
                                {{0, 0}, {0, -1}, {-1, -1}, {-1, 0}}};
  const FloorPlan plan = test::plan_of(boundary);
  ASSERT_EQ(plan.walls().size(), 12u);
  for (const PlanWall& wall : plan.walls()) {
    ASSERT_NE(wall.next, PlanWall::kNone);
    if (wall.end() != Vec2(0, 0)) continue;
    // The wall that comes along the x axis goes on along the y axis of the same quadrant, which is free.
    const Vec2 back = -wall.end_direction(), on = plan.walls()[wall.next].start_direction();
    EXPECT_NEAR(std::abs(back.dot(on)), 0.0, 1e-12);
    EXPECT_LT((back + on).x() * (back + on).y(), 0.0);
  }
}

TEST(FloorPlan, RayMeetsTheNearestWallFromItsFreeSide) {
  const FloorPlan plan = test::plan_of(test::niche_room());
  const auto hit = plan.first_hit({2, 1}, {0, -1}, 5);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->range_m, 1.3, 1e-12);
  EXPECT_NEAR(hit->along_m, 0.5, 1e-12);
  EXPECT_EQ(hit->direction, Vec2(1, 0));
  EXPECT_FALSE(plan.first_hit({2, 1}, {0, -1}, 1.2).has_value());
  EXPECT_FALSE(plan.first_hit({2, -5}, {0, 1}, 4.9).has_value()) << "from behind";
}

TEST(FloorPlan, RaysAgreeWithSmallSteps) {
  const FloorPlan plan = test::plan_of(test::doorway_hall());
  // Free space by hand.
  const auto is_free = [](const Vec2& p) {
    const auto in = [&](double x0, double y0, double x1, double y1) {
      return p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1;
    };
    return in(0, 0, 20, 2) || in(2, -3.2, 5, -0.2) || in(3, -0.2001, 4, 0.0001) || in(7, -8, 8.5, 0.0001);
  };
  for (int i = 0; i < 200; ++i) {
    const double angle = 0.1 + 0.37 * i;
    const Vec2 from(1 + 0.09 * i, 1.1), direction(std::cos(angle), std::sin(angle));
    const auto hit = plan.first_hit(from, direction, 30);
    ASSERT_TRUE(hit.has_value());
    double range = 0.0;
    while (is_free(from + (range + 0.001) * direction)) range += 0.001;
    EXPECT_NEAR(hit->range_m, range, 0.003) << i;
  }
}

}  // namespace
}  // namespace hallway::eval
