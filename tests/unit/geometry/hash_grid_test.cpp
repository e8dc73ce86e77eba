// SPDX-License-Identifier: MIT
#include "geometry/hash_grid.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "unit/geometry/mixed_points.hpp"

namespace hallway {
namespace {

/// Squared distance from `place` to the nearest of the points that the grid visits.
double nearest2_of(const HashGrid& grid, const std::vector<Vec3>& points, const Vec3& place) {
  double nearest2 = std::numeric_limits<double>::infinity();
  grid.visit_near(place,
                  [&](std::uint32_t i) { nearest2 = std::min(nearest2, (points[i] - place).squaredNorm()); });
  return nearest2;
}

TEST(HashGrid, NearestIsThatOfALoopOverAllPoints) {
  for (const double reach : {0.1, 0.7, 3.0}) {
    const std::vector<Vec3> points = test::mixed_points(11);
    HashGrid grid(reach);
    for (const Vec3& p : points) grid.add(p);
    std::mt19937_64 random(12);
    int found_some = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec3 place = i % 3 == 0 ? points[random() % points.size()] : test::somewhere(random);
      const double nearest2 = test::all_distances2(points, place).front();
      if (nearest2 > reach * reach) continue;
      ++found_some;
      EXPECT_EQ(nearest2_of(grid, points, place), nearest2);
    }
    EXPECT_GE(found_some, 100);
  }
}

TEST(HashGrid, FollowsPointsThatMoveAndForgetsThoseThatGo) {
  std::vector<Vec3> points = test::mixed_points(13);
  HashGrid grid(0.7);
  for (const Vec3& p : points) grid.add(p);
  std::mt19937_64 random(14);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    points[i] += (i % 2 == 0 ? 0.01 : 1.0) * test::somewhere(random);
    grid.move(i, points[i]);
  }
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (i % 3 != 0) {
      EXPECT_EQ(nearest2_of(grid, points, points[i]), 0.0) << i;
    } else {
      grid.remove(i);
      grid.visit_near(points[i], [&](std::uint32_t other) { EXPECT_NE(other, i); });
    }
  }
}

}  // namespace
}  // namespace hallway
