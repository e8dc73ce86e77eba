// SPDX-License-Identifier: MIT
#include "slam_point/core/hash_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "scenes.hpp"

namespace hallway::slam_point {
namespace {

/// Points within reach, by looking at all of them.
std::vector<std::uint32_t> all_near(const std::vector<Vec3>& points, const std::vector<bool>& gone,
                                    const Vec3& p, double reach) {
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!gone[i] && (points[i] - p).norm() <= reach) near.push_back(i);
  }
  return near;
}

std::vector<std::uint32_t> grid_near(const HashGrid& grid, const std::vector<Vec3>& points, const Vec3& p,
                                     double reach) {
  std::vector<std::uint32_t> near;
  grid.visit_near(p, [&](std::uint32_t i) {
    if ((points[i] - p).norm() <= reach) near.push_back(i);
  });
  std::sort(near.begin(), near.end());
  return near;
}

TEST(HashGrid, FindsWhatLookingAtAllPointsFinds) {
  constexpr double kReach = 0.8;
  scenes::Random random(1);
  const auto place = [&random] {
    return Vec3(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-3, 3));
  };
  HashGrid grid(kReach);
  std::vector<Vec3> points;
  std::vector<bool> gone;
  for (int i = 0; i < 3000; ++i) {  // past the first growth of the table
    points.push_back(place());
    gone.push_back(false);
    grid.add(points.back());
    const auto moved = static_cast<std::uint32_t>(random.uniform(0.0, static_cast<double>(points.size())));
    if (i % 3 == 0 && !gone[moved]) grid.move(moved, points[moved] = place());
    if (i % 7 == 0 && !gone[moved]) {
      grid.remove(moved);
      gone[moved] = true;
    }
  }
  for (int query = 0; query < 500; ++query) {
    const Vec3 p = place();
    EXPECT_EQ(grid_near(grid, points, p, kReach), all_near(points, gone, p, kReach));
  }
}

TEST(HashGrid, VisitsEachPointOnce) {
  HashGrid grid(1.0);
  for (int i = 0; i < 100; ++i) grid.add(Vec3(0.01 * i, 0.0, 0.0));
  std::vector<int> visits(100, 0);
  grid.visit_near(Vec3(0.5, 0.0, 0.0), [&](std::uint32_t i) { ++visits[i]; });
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 100);
}

TEST(HashGrid, FarCoordinatesDoNotOverflow) {
  HashGrid grid(1e-3);
  const std::vector<Vec3> points{{1e6, -1e6, 1e6}, {1e300, 0.0, 0.0}};
  for (const Vec3& p : points) grid.add(p);
  EXPECT_EQ(grid_near(grid, points, points[0], 1e-3), std::vector<std::uint32_t>{0});
}

TEST(HashGrid, IsEmptyAfterClear) {
  HashGrid grid(1.0);
  grid.add(Vec3::Zero());
  grid.clear();
  int visits = 0;
  grid.visit_near(Vec3::Zero(), [&](std::uint32_t) { ++visits; });
  EXPECT_EQ(visits, 0);
}

}  // namespace
}  // namespace hallway::slam_point
