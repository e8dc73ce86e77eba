// SPDX-License-Identifier: MIT
// The parts that `auto` is made of, against what is slow or simple and surely right.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "em/core/canonical.hpp"
#include "em/core/cells.hpp"
#include "em/core/moments.hpp"
#include "em/core/neighbours.hpp"
#include "em/core/seeds.hpp"
#include "em/core/slab_points.hpp"
#include "support/dense.hpp"
#include "unit/em/auto_scene.hpp"

namespace hallway::em {
namespace {

using namespace hallway::em::test;  // NOLINT

TEST(CanonicalOrder, HoldsEachPlaceOnceWithAllThatGaveIt) {
  Workers alone(1);
  LabelledPoints cloud = room();
  cloud.points.push_back(cloud.points[7]);
  cloud.points.push_back(cloud.points[7]);
  const CanonicalCloud canonical = canonical_order(cloud.points, alone);
  ASSERT_EQ(canonical.points.count, cloud.points.size() - 2);
  std::vector<int> seen(cloud.points.size(), 0);
  for (std::size_t i = 0; i < canonical.points.count; ++i) {
    const Vec3 back = canonical.frame.to_cloud(canonical.points.at(i));
    for (const PointIndex given : canonical.given_at(i)) {
      ++seen[given];
      EXPECT_LT((back - cloud.points[given]).norm(), 1e-12);
    }
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
  EXPECT_NEAR(canonical.frame.axes.determinant(), 1.0, 1e-12);
}

TEST(CanonicalOrder, MostNeighboursInTheListAreNearInSpace) {
  Workers alone(1);
  const CanonicalCloud canonical = canonical_order(room().points, alone);
  double steps = 0.0;
  for (std::size_t i = 1; i < canonical.points.count; ++i) {
    steps += (canonical.points.at(i) - canonical.points.at(i - 1)).norm();
  }
  EXPECT_LT(steps / static_cast<double>(canonical.points.count), 0.4);  // in a cube of 10
}

TEST(BoxTree, NearestAndSlabAgreeWithLookingAtEachPoint) {
  Workers alone(1);
  const CanonicalCloud canonical = canonical_order(room().points, alone);
  const Points& points = canonical.points;
  const BoxTree tree(points, alone);
  const PointField field{points, tree};
  std::vector<NearPoint> near;
  for (std::size_t middle = 0; middle < points.count; middle += 397) {
    nearest(field, points.at(middle), 30, middle % 2 == 0 ? 1e-3 : 3.0, near);
    std::vector<double> all;
    for (std::size_t i = 0; i < points.count; ++i)
      all.push_back((points.at(i) - points.at(middle)).squaredNorm());
    std::sort(all.begin(), all.end());
    ASSERT_EQ(near.size(), 30u);
    for (std::size_t k = 0; k < near.size(); ++k) ASSERT_EQ(near[k].squared_distance, all[k]);

    const Slab slab{frame_on(points.at(middle), Vec3(1, 2, 2) / 3.0), 0.3, -1.0, 2.0, -1.5, 0.5};
    SlabPoints found;
    collect(field, slab, found);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < points.count; ++i) {
      const Vec3 from = points.at(i) - slab.frame.origin;
      const double a = slab.frame.u.dot(from);
      const double b = slab.frame.v.dot(from);
      if (std::abs(slab.frame.normal.dot(from)) <= 0.3 && a >= -1.0 && a <= 2.0 && b >= -1.5 && b <= 0.5) {
        expected.push_back(i);
      }
    }
    EXPECT_EQ(found.place, expected);
    std::vector<std::uint32_t> in_chunks;
    for (std::size_t chunk = 0; chunk < tree.chunks(); ++chunk) {
      collect_chunk(field, chunk, slab, found);
      for (const std::uint32_t i : found.place) {
        EXPECT_EQ(i / BoxTree::kChunkSize, chunk);
        in_chunks.push_back(i);
      }
    }
    EXPECT_EQ(in_chunks, expected);
  }
  EXPECT_EQ(tree.chunks(), 3u);
}

TEST(Moments, VariancesAgreeWithTheEigensolverAndPartsAddUp) {
  const LabelledPoints cloud = room();
  Moments first, second, all;
  for (std::size_t i = 0; i < 900; ++i) {
    (i % 3 == 0 ? first : second).add(cloud.points[i], 0.5);
    all.add(cloud.points[i], 0.5);
  }
  first.join(second);
  const Vec3 expected = dense::eigenvalues_of(all.covariance());
  EXPECT_LT((all.variances() - expected).norm(), 1e-8 * expected[2]);
  EXPECT_LT((first.covariance() - all.covariance()).norm(), 1e-12);
  const PlaneFit fit = all.fit(Vec3(1, 1, 1));
  EXPECT_LT((fit.frame.origin - Vec3(1, 1, 1) - all.mean()).norm(), 1e-12);
  EXPECT_LT((fit.frame.u.cross(fit.frame.v) - fit.frame.normal).norm(), 1e-12);
}

TEST(Cells, ClosingFillsGapsAndComponentsAreCounted) {
  CellGrid grid{0.0, 0.0, 1.0, 12, 5};
  CellMap<std::uint8_t> cells(grid.size(), 0);
  for (const int column : {2, 3, 6, 9}) cells[grid.place(column, 2)] = 1;
  std::uint32_t count = 0;
  components(grid, cells, count);
  EXPECT_EQ(count, 3u);
  const CellMap<std::uint8_t> filled = closed(grid, cells, 1);
  for (int column = 0; column < grid.columns; ++column) {
    EXPECT_EQ(filled[grid.place(column, 2)], column >= 2 && column <= 9 ? 1 : 0) << column;
    EXPECT_EQ(filled[grid.place(column, 1)], 0) << column;
  }
  const CellMap<std::uint8_t> largest = largest_component(grid, cells);
  EXPECT_EQ(std::count(largest.begin(), largest.end(), 1), 2);
  EXPECT_EQ(connected(grid, cells, {grid.place(6, 2)})[grid.place(6, 2)], 1);
}

TEST(Seeds, TheFlattestTellTheNoise) {
  Workers alone(1);
  for (const double sigma : {0.005, 0.02, 0.05}) {
    const CanonicalCloud canonical = canonical_order(room(sigma).points, alone);
    const std::vector<Seed> seeds = find_seeds(canonical.points, 64, 0, alone);
    ASSERT_GE(seeds.size(), 32u);
    EXPECT_NEAR(noise_of_seeds(seeds), sigma, 0.25 * sigma);
    for (std::size_t k = 1; k < seeds.size(); ++k) EXPECT_LE(seeds[k - 1].flatness, seeds[k].flatness);
  }
}

}  // namespace
}  // namespace hallway::em
