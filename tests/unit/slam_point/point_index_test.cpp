// SPDX-License-Identifier: MIT
#include "slam_point/core/index/point_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/mapper.hpp"

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

std::vector<std::uint32_t> index_near(const PointIndex& index, const std::vector<Vec3>& points, const Vec3& p,
                                      double reach) {
  std::vector<std::uint32_t> near;
  index.visit_near(p, [&](std::uint32_t i) {
    if ((points[i] - p).norm() <= reach) near.push_back(i);
  });
  std::sort(near.begin(), near.end());
  return near;
}

class Indices : public testing::TestWithParam<IndexKind> {};

TEST_P(Indices, FindWhatLookingAtAllPointsFinds) {
  constexpr double kReach = 0.8;
  // A region that all structures divide, and one so wide that nearly every point is alone.
  for (const double size : {9.0, 900.0}) {
    scenes::Random random(1);
    const auto place = [&] {
      return Vec3(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-3, 3));
    };
    PointIndex index(GetParam(), kReach);
    std::vector<Vec3> points;
    std::vector<bool> gone;
    for (int i = 0; i < 3000; ++i) {  // past the first growth of the grid's table
      points.push_back(place());
      gone.push_back(false);
      index.add(points.back());
      const auto moved = static_cast<std::uint32_t>(random.uniform(0.0, static_cast<double>(points.size())));
      if (i % 3 == 0 && !gone[moved]) index.move(moved, points[moved] = place());
      if (i % 7 == 0 && !gone[moved]) {
        index.remove(moved);
        gone[moved] = true;
      }
    }
    for (int query = 0; query < 500; ++query) {
      const Vec3 p =
          query % 2 == 0 ? place() : Vec3(points[static_cast<std::size_t>(query)] + 0.1 * place() / size);
      ASSERT_EQ(index_near(index, points, p, kReach), all_near(points, gone, p, kReach));
    }
  }
}

TEST_P(Indices, FindPointsThatCreepAndThatAreFollowed) {
  constexpr double kReach = 0.5;
  scenes::Random random(2);
  PointIndex index(GetParam(), kReach);
  std::vector<Vec3> points;
  for (int i = 0; i < 300; ++i) {
    points.emplace_back(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-1, 1));
    index.add(points.back());
  }
  const std::vector<bool> gone(points.size(), false);
  for (int step = 0; step < 200; ++step) {
    // All creep off, past what was the border of the world at first.
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      points[i] += Vec3(0.3, 0.01 * random.normal(), 0.01 * random.normal());
      index.move(i, points[i]);
    }
    const Vec3& p = points[static_cast<std::size_t>(step)];
    ASSERT_EQ(index_near(index, points, p, kReach), all_near(points, gone, p, kReach)) << step;
  }
}

TEST_P(Indices, FindPointsOnBordersAndInOnePlace) {
  PointIndex index(GetParam(), 1.0);
  std::vector<Vec3> points;
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; ++y) points.emplace_back(2.0 * x, 2.0 * y, 0.0);
  }
  for (int i = 0; i < 50; ++i) points.emplace_back(1.0, 1.0, 0.0);
  for (const Vec3& p : points) index.add(p);
  const std::vector<bool> gone(points.size(), false);
  for (const Vec3& p : points) ASSERT_EQ(index_near(index, points, p, 1.0), all_near(points, gone, p, 1.0));
}

TEST_P(Indices, VisitEachPointOnce) {
  PointIndex index(GetParam(), 1.0);
  for (int i = 0; i < 100; ++i) index.add(Vec3(0.01 * i, 0.0, 0.0));
  std::vector<int> visits(100, 0);
  index.visit_near(Vec3(0.5, 0.0, 0.0), [&](std::uint32_t i) { ++visits[i]; });
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 100);
}

TEST_P(Indices, FarCoordinatesDoNotOverflow) {
  PointIndex index(GetParam(), 1e-3);
  const std::vector<Vec3> points{{1e6, -1e6, 1e6}, {1e300, 0.0, 0.0}};
  for (const Vec3& p : points) index.add(p);
  EXPECT_EQ(index_near(index, points, points[0], 1e-3), std::vector<std::uint32_t>{0});
}

TEST_P(Indices, AreEmptyAfterClear) {
  PointIndex index(GetParam(), 1.0);
  index.add(Vec3::Zero());
  index.clear();
  int visits = 0;
  index.visit_near(Vec3::Zero(), [&](std::uint32_t) { ++visits; });
  EXPECT_EQ(visits, 0);
  index.add(Vec3::Ones());
  index.visit_near(Vec3::Ones(), [&](std::uint32_t i) { visits += i == 0 ? 1 : 100; });
  EXPECT_EQ(visits, 1);
}

TEST_P(Indices, GiveTheSameMapToTheLastBit) {
  const scenes::Log log = scenes::figure_eight(300, 25, 3);
  Options options;
  Mapper with_grid(options);
  options.index = static_cast<int>(GetParam());
  Mapper mapper(options);
  for (const auto& seen : log.frames) {
    std::vector<Vec3> points;
    for (const scenes::Seen& s : seen) points.push_back(s.point);
    const Answer& expected = with_grid.process(points);
    const Answer& answer = mapper.process(points);
    ASSERT_EQ(answer.associations, expected.associations);
    ASSERT_EQ(answer.T_map_sensor.t, expected.T_map_sensor.t);
    ASSERT_EQ(answer.T_map_sensor.q.coeffs(), expected.T_map_sensor.q.coeffs());
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Indices,
                         testing::Values(IndexKind::grid, IndexKind::quadtree, IndexKind::octree,
                                         IndexKind::kdtree),
                         [](const auto& instance) { return kIndexNames[static_cast<int>(instance.param)]; });

}  // namespace
}  // namespace hallway::slam_point
