// SPDX-License-Identifier: MIT
// Spacing and thinning, against what a loop over all points says.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "clouds.hpp"
#include "icp/core/cloud_scale.hpp"
#include "icp/core/normals.hpp"

namespace hallway::icp {
namespace {

using clouds::Random;

/// Scattered points, points of a lattice (many ties) and copies.
Points mixed(std::uint64_t seed) {
  Random random(seed);
  Points points = clouds::scattered(300, seed);
  for (int i = 0; i < 300; ++i) {
    points.push_back(Vec3(static_cast<double>(random.below(6)), static_cast<double>(random.below(6)),
                          static_cast<double>(random.below(3))));
  }
  return points;
}

TEST(CloudScale, SpacingOfALatticeIsItsStepWhateverItsCopies) {
  Points points;
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 5; ++y)
      points.insert(points.end(), {Vec3(0.3 * x, 0.3 * y, 0), Vec3(0.3 * x, 0.3 * y, 0)});
  }
  EXPECT_NEAR(spacing_of(points, KdTree(points)), 0.3, 1e-12);
  const Points same(20, Vec3(1, 2, 3));
  EXPECT_EQ(spacing_of(same, KdTree(same)), 0.0);
  EXPECT_EQ(spacing_of({}, KdTree(Points())), 0.0);
}

TEST(CloudScale, ExtentIsThatOfMostPoints) {
  Points points = clouds::scattered(1000, 13);
  const double extent = extent_of(points);
  EXPECT_GT(extent, 10.0);
  EXPECT_LT(extent, 20.0);
  for (int i = 0; i < 50; ++i) points.push_back(Vec3(1e8, 1e8, 1e8));
  EXPECT_NEAR(extent_of(points), extent, 1.0);
  EXPECT_EQ(extent_of({}), 0.0);
}

TEST(CloudScale, ThinnedHasTheMeanOfEachCubeInAnyOrder) {
  const Points points = mixed(14);
  const Points thin = thinned(points, 1.0);
  EXPECT_LT(thin.size(), points.size());
  Vec3 sum = Vec3::Zero();
  for (const Vec3& mean : thin) {
    Vec3 inside = Vec3::Zero();
    int count = 0;
    const Eigen::Array3d cube = mean.array().floor();
    for (const Vec3& p : points) {
      if ((p.array().floor() != cube).any()) continue;
      inside += p;
      ++count;
    }
    ASSERT_GT(count, 0);
    EXPECT_LT((inside / count - mean).norm(), 1e-12);
    sum += count * mean;
  }
  EXPECT_LT((sum - std::accumulate(points.begin(), points.end(), Vec3(Vec3::Zero()))).norm(), 1e-9);
  EXPECT_EQ(thin, thinned(clouds::shuffled(points, 15), 1.0));
}

TEST(CloudScale, ASampleDependsOnTheCoordinatesAlone) {
  const Points points = clouds::scattered(1000, 17);
  const Points sample = sampled(points, 300);
  ASSERT_EQ(sample.size(), 300u);
  EXPECT_EQ(sample, sampled(clouds::shuffled(points, 18), 300));
  EXPECT_NEAR(extent_of(sample), extent_of(points), 1.0) << "of all parts";
  for (const Vec3& p : sample) EXPECT_NE(std::find(points.begin(), points.end(), p), points.end());
  EXPECT_EQ(sampled(points, 1000), points);
}

TEST(Normals, ArePerpendicularToTheSurface) {
  Random random(16);
  const Vec3 normal = Vec3(1, -2, 0.5).normalized();
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  Points points;
  for (int i = 0; i < 200; ++i) points.push_back(random.uniform(-5, 5) * u + random.uniform(-5, 5) * v);
  for (const Vec3& each : normals_of(points, KdTree(points), 10))
    EXPECT_NEAR(std::abs(each.dot(normal)), 1.0, 1e-9);
}

TEST(Normals, OfPointsOnALineAreNone) {
  Points line;
  for (int i = 0; i < 20; ++i) line.push_back(Vec3(i, 2 * i, -i));
  for (const Vec3& each : normals_of(line, KdTree(line), 8)) EXPECT_EQ(each, Vec3(Vec3::Zero()));
  const Points two{Vec3(0, 0, 0), Vec3(1, 0, 0)};
  for (const Vec3& each : normals_of(two, KdTree(two), 8)) EXPECT_EQ(each, Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace hallway::icp
