// SPDX-License-Identifier: MIT
#include "sense/wall_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "map/world.hpp"
#include "unit/sense/map_text.hpp"
#include "unit/sense/plane_fixture.hpp"

namespace hallway::sense {
namespace {

using test::box_brush;

csg::Surface surface_of(const std::vector<std::string>& brushes) {
  return csg::build_surface(map::build_world(test::parse_map(test::worldspawn({}, brushes))));
}

WallPlan plan_at(double height_m, const std::vector<std::string>& brushes) {
  return make_wall_plan(surface_of(brushes), {}, height_m);
}

/// The walls that face along -y, from left to right.
std::vector<Wall> southern(const WallPlan& plan) {
  std::vector<Wall> walls;
  for (const Wall& wall : plan.walls) {
    if (wall.normal().y() < -0.99) walls.push_back(wall);
  }
  std::sort(walls.begin(), walls.end(), [](const Wall& a, const Wall& b) { return a.left.x() < b.left.x(); });
  return walls;
}

void expect_wall(const Wall& wall, const Vec2& left, const Vec2& right, double low_m, double high_m) {
  EXPECT_LT((wall.left - left).norm(), 1e-9) << wall.left.transpose();
  EXPECT_LT((wall.right - right).norm(), 1e-9) << wall.right.transpose();
  EXPECT_NEAR(wall.low_m, low_m, 1e-9);
  EXPECT_NEAR(wall.high_m, high_m, 1e-9);
}

TEST(WallPlan, HasTheFourWallsOfABox) {
  const WallPlan plan = plan_at(1.0, {box_brush({0, 0, 0}, {4, 2, 3})});
  ASSERT_EQ(plan.walls.size(), 4u);
  EXPECT_EQ(plan.obstacles.size(), 4u);
  const Vec2 middle(2, 1);
  for (const Wall& wall : plan.walls) {
    EXPECT_GT(wall.normal().dot(0.5 * (wall.left + wall.right) - middle), 0.99);
    EXPECT_EQ(wall.low_m, 0.0);
    EXPECT_EQ(wall.high_m, 3.0);
  }
  expect_wall(southern(plan).at(0), {0, 0}, {4, 0}, 0, 3);
}

TEST(WallPlan, HasNothingWhereNothingIsAtTheHeight) {
  for (const double height_m : {-1.0, 3.5}) {
    const WallPlan plan = plan_at(height_m, {box_brush({0, 0, 0}, {4, 2, 3})});
    EXPECT_TRUE(plan.walls.empty());
    EXPECT_TRUE(plan.obstacles.empty());
  }
}

TEST(WallPlan, CutsWhatEndsAtTheHeightAndNotWhatBeginsThere) {
  EXPECT_EQ(plan_at(3.0, {box_brush({0, 0, 0}, {4, 2, 3})}).walls.size(), 4u);
  EXPECT_TRUE(plan_at(0.0, {box_brush({0, 0, 0}, {4, 2, 3})}).walls.empty());
}

TEST(WallPlan, JoinsWhatIsOnOnePlaneWhateverBrushesItIsOf) {
  const WallPlan plan = plan_at(1.0, {box_brush({0, 0, 0}, {2, 1, 3}), box_brush({2, 0, 0}, {5, 1, 1.5}),
                                      box_brush({2, 0, 1.5}, {5, 1, 3}), box_brush({5, -1, 0}, {6, 1, 3})});
  const auto walls = southern(plan);
  ASSERT_EQ(walls.size(), 2u);
  expect_wall(walls[0], {0, 0}, {5, 0}, 0, 3);
  expect_wall(walls[1], {5, -1}, {6, -1}, 0, 3);
}

TEST(WallPlan, ReachesAsHighAsTheSurfaceDoesBetweenItsEnds) {
  // Low beside high: one wall at the height of both, two heights' sum; above the low one only the high one.
  const std::vector<std::string> brushes{box_brush({0, 0, 0}, {2, 1, 3}), box_brush({2, 0, 0}, {5, 1, 1.5})};
  const auto low = southern(plan_at(1.0, brushes));
  ASSERT_EQ(low.size(), 1u);
  expect_wall(low[0], {0, 0}, {5, 0}, 0, 3);
  const auto high = southern(plan_at(2.0, brushes));
  ASSERT_EQ(high.size(), 1u);
  expect_wall(high[0], {0, 0}, {2, 0}, 0, 3);
}

TEST(WallPlan, HasTwoWallsBesideADoorAndOneAboveIt) {
  const std::vector<std::string> brushes{box_brush({0, 0, 0}, {2, 0.2, 3}), box_brush({3, 0, 0}, {5, 0.2, 3}),
                                         box_brush({2, 0, 2}, {3, 0.2, 2.5}),
                                         box_brush({2, 0, 2.5}, {3, 0.2, 3})};
  const auto walls = southern(plan_at(1.0, brushes));
  ASSERT_EQ(walls.size(), 2u);
  expect_wall(walls[0], {0, 0}, {2, 0}, 0, 3);
  expect_wall(walls[1], {3, 0}, {5, 0}, 0, 3);
  const auto lintel = southern(plan_at(2.2, brushes));
  ASSERT_EQ(lintel.size(), 1u);
  expect_wall(lintel[0], {0, 0}, {5, 0}, 0, 3);
}

TEST(WallPlan, IsInterruptedByWhatStandsAgainstIt) {
  const std::vector<std::string> brushes{box_brush({0, 0, 0}, {5, 0.2, 3}),
                                         box_brush({2, -0.5, 0}, {3, 0, 1.5})};
  const auto walls = southern(plan_at(1.0, brushes));
  ASSERT_EQ(walls.size(), 3u);
  expect_wall(walls[0], {0, 0}, {2, 0}, 0, 3);
  expect_wall(walls[1], {2, -0.5}, {3, -0.5}, 0, 1.5);
  expect_wall(walls[2], {3, 0}, {5, 0}, 0, 3);
  EXPECT_EQ(southern(plan_at(2.0, brushes)).size(), 1u);
}

TEST(WallPlan, KeepsApartWhatFacesOtherwiseOrLiesOnAnotherPlane) {
  // A row of boxes, each 1 cm behind the one before.
  const WallPlan plan = plan_at(1.0, {box_brush({0, 0, 0}, {1, 1, 3}), box_brush({1, 0.01, 0}, {2, 1, 3})});
  EXPECT_EQ(southern(plan).size(), 2u);
}

TEST(WallPlan, MakesWallsOfWhatIsWantedAlone) {
  const csg::Surface surface = surface_of({box_brush({0, 0, 0}, {4, 2, 3})});
  const auto wanted = [&](std::size_t i) { return surface.polygons[i].plane.normal.x() > 0.5; };
  const WallPlan plan = make_wall_plan(surface, wanted, 1.0);
  ASSERT_EQ(plan.walls.size(), 1u);
  expect_wall(plan.walls[0], {4, 0}, {4, 2}, 0, 3);
  EXPECT_EQ(plan.obstacles.size(), 4u);
}

TEST(WallPlan, TakesSlopesAndMeshesForObstaclesAlone) {
  csg::Surface slope;
  slope.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 2, 2}, {0, 2, 2}};
  slope.polygons.push_back({.plane = {Vec3(0, -1, 1).normalized(), 0.0}, .vertices = {0, 1, 2, 3}});
  trace::TriangleMesh mesh;
  mesh.vertices = {{9, 0, 0}, {9, 4, 0}, {9, 2, 2}};
  mesh.triangles = {{0, 1, 2}};
  const WallPlan plan = make_wall_plan(slope, {}, 0.5, std::span(&mesh, 1));
  EXPECT_TRUE(plan.walls.empty());
  ASSERT_EQ(plan.obstacles.size(), 2u);
  EXPECT_NEAR(plan.obstacles[0].from.y(), 0.5, 1e-12);
  EXPECT_NEAR((plan.obstacles[0].from - plan.obstacles[0].to).norm(), 4.0, 1e-12);
  EXPECT_NEAR((plan.obstacles[1].from - plan.obstacles[1].to).norm(), 3.0, 1e-12);
}

TEST(WallPlan, IsClosedAroundEverySolid) {
  // Overlapping prisms at all angles: every end of an obstacle is the beginning of another, and walls are all of them.
  const std::vector<Vec2> turned{{1, -1}, {3, 0.5}, {1.5, 2.5}, {-0.5, 1}};
  const WallPlan plan = plan_at(1.0, {box_brush({0, 0, 0}, {4, 2, 3}), test::prism_brush(turned, -1, 2),
                                      test::prism_brush({{3, 1}, {6, 1.2}, {5, 3}}, 0.5, 1.7)});
  std::multiset<std::pair<double, double>> from, to;
  double obstacles_m = 0.0, walls_m = 0.0;
  for (const Obstacle& obstacle : plan.obstacles) {
    from.insert({obstacle.from.x(), obstacle.from.y()});
    to.insert({obstacle.to.x(), obstacle.to.y()});
    obstacles_m += (obstacle.to - obstacle.from).norm();
  }
  EXPECT_EQ(from, to);
  for (const Wall& wall : plan.walls) walls_m += wall.length_m();
  EXPECT_NEAR(walls_m, obstacles_m, 1e-9);
  EXPECT_GT(plan.walls.size(), 9u);
}

}  // namespace
}  // namespace hallway::sense
