// SPDX-License-Identifier: MIT
// What em1 and em2 are made of: order, neighbours, scale, merging, shares, density.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "em/core/cloud_scale.hpp"
#include "em/core/dense_part.hpp"
#include "em/core/plane_merge.hpp"
#include "em/core/sorted_cloud.hpp"
#include "patches.hpp"

namespace hallway::em {
namespace {

std::vector<std::uint32_t> all_of(std::size_t count) {
  std::vector<std::uint32_t> places(count);
  std::iota(places.begin(), places.end(), 0u);
  return places;
}

Candidate candidate_of(std::span<const Vec3> points, std::vector<std::uint32_t> members) {
  Candidate plane;
  plane.members = std::move(members);
  plane.fresh = false;
  EXPECT_TRUE(maximise(plane, points));
  return plane;
}

TEST(SortedCloud, LeavesOutWhatIsNotFiniteAndKeepsEachPlaceOnce) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<Vec3> cloud{{3, 0, 0},    {nan, 0, 0},  {1, 0, 0},    {3, 0, 0},
                                {0, -inf, 0}, {1, -0.0, 0}, {2, 0, 1e200}};
  const SortedCloud sorted = sort_cloud(cloud);
  ASSERT_EQ(sorted.points.size(), 2u);
  EXPECT_EQ(sorted.place_of, (std::vector<std::uint32_t>{1, kNoPlane, 0, 1, kNoPlane, 0, kNoPlane}));
  for (const std::size_t i : {0u, 2u, 3u, 5u})
    EXPECT_EQ(sorted.points[sorted.place_of[i]] + sorted.origin, cloud[i]);
  EXPECT_TRUE(sort_cloud({}).points.empty());
}

TEST(OrientedBox, ATreeFindsWhatALookAtAllPointsFinds) {
  const std::vector<Vec3> points = planted::cloud_of(planted::random_patch(1), 1);
  const KdTree tree(points);
  std::vector<Neighbour> nearest;
  planted::Numbers numbers(1);
  for (int round = 0; round < 50; ++round) {
    const Vec3 p = points[numbers.below(points.size())] + 0.2 * planted::random_direction(numbers);
    std::vector<Neighbour> expected;
    for (std::uint32_t i = 0; i < points.size(); ++i) expected.push_back({(points[i] - p).squaredNorm(), i});
    std::sort(expected.begin(), expected.end());
    tree.nearest(p, 20, nearest);
    ASSERT_EQ(nearest.size(), 20u);
    for (std::size_t i = 0; i < nearest.size(); ++i) EXPECT_EQ(nearest[i].index, expected[i].index);

    const PlaneFrame frame = flat_frame(planted::random_direction(numbers), p);
    const OrientedBox box{p, {frame.u, frame.v, frame.u.cross(frame.v)}, Vec3(0.5, 0.3, 0.2)};
    std::vector<std::uint32_t> inside;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if (box.contains(points[i])) inside.push_back(i);
    }
    EXPECT_EQ(tree.within(box), inside);
  }
  tree.nearest(points[0], 1000, nearest);
  EXPECT_EQ(nearest.size(), points.size());
}

TEST(CloudScale, IsNearTheTruthForPatches) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    planted::Patch patch = planted::random_patch(seed);
    patch.points = 2000;
    patch.sigma = seed < 5 ? 0.005 : 0.02;
    const std::vector<Vec3> points = planted::cloud_of(patch, seed);
    const CloudScale scale = measure_scale(points, KdTree(points));
    const double spacing = std::sqrt(4.0 * patch.half_u * patch.half_v / 2000.0);
    EXPECT_GT(scale.spacing, 0.8 * spacing);
    EXPECT_LT(scale.spacing, 1.4 * spacing);
    EXPECT_GT(scale.noise, 0.75 * patch.sigma);
    EXPECT_LT(scale.noise, 1.15 * patch.sigma);
  }
  EXPECT_EQ(measure_scale({}, KdTree({})).spacing, 0.0);
}

// A patch in the plane z = `height`, from `x` on, on a lattice.
std::vector<Vec3> tile(double x, double height, double tilt = 0.0) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10; ++j) points.emplace_back(x + 0.1 * i, 0.1 * j, height + tilt * 0.1 * i);
  }
  return points;
}

bool would_merge(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<Vec3> points = a;
  points.insert(points.end(), b.begin(), b.end());
  std::vector<std::uint32_t> first = all_of(a.size());
  std::vector<std::uint32_t> second = all_of(points.size());
  second.erase(second.begin(), second.begin() + static_cast<std::ptrdiff_t>(a.size()));
  std::vector<Candidate> planes{candidate_of(points, first), candidate_of(points, second)};
  const MergeBounds bounds{std::cos(10.0 * M_PI / 180.0), 0.1, 0.2};
  EXPECT_EQ(mergeable(planes[0], planes[1], bounds), mergeable(planes[1], planes[0], bounds));
  merge_alike(planes, points, bounds);
  if (planes.size() == 1) {
    EXPECT_EQ(planes[0].members, all_of(points.size()));
  }
  return planes.size() == 1;
}

TEST(Merge, AsksForAngleOffsetAndOverlap) {
  EXPECT_TRUE(would_merge(tile(0.0, 0.0), tile(0.5, 0.0)));
  EXPECT_TRUE(would_merge(tile(0.0, 0.0), tile(1.1, 0.05)));
  EXPECT_FALSE(would_merge(tile(0.0, 0.0), tile(1.3, 0.0)));        // a gap of 0.3
  EXPECT_FALSE(would_merge(tile(0.0, 0.0), tile(0.5, 0.15)));       // beside each other
  EXPECT_FALSE(would_merge(tile(0.0, 0.0), tile(0.0, -0.1, 0.2)));  // crossing at 11 degrees
  EXPECT_TRUE(would_merge(tile(0.0, 0.0), tile(0.0, -0.05, 0.1)));
}

TEST(Shares, PlanesWithoutPointsOfTheirOwnGoTheWorstFirst) {
  const std::vector<Vec3> points = tile(0.0, 0.0);
  std::vector<std::uint32_t> low, high;
  for (const std::uint32_t i : all_of(points.size())) (points[i].x() < 0.55 ? low : high).push_back(i);
  // The first and the last are the same; one of them must stay. The second one's points belong to others throughout.
  std::vector<Candidate> planes{candidate_of(points, low),
                                candidate_of(points, {low[0], low[20], high[0], high[20]}),
                                candidate_of(points, high), candidate_of(points, low)};
  EXPECT_DOUBLE_EQ(exclusive_share(planes[2], count_uses(planes, points.size())),
                   1.0 - 2.0 / static_cast<double>(high.size()));
  std::vector<Candidate> fresh = planes;
  fresh[1].fresh = true;
  drop_shared(planes, points.size(), 0.5);
  ASSERT_EQ(planes.size(), 2u);
  EXPECT_EQ(planes[0].members.size() + planes[1].members.size(), points.size());
  drop_shared(fresh, points.size(), 0.5);
  EXPECT_EQ(fresh.size(), 3u);
}

TEST(DensePart, EndsAtAGapAndBeforeASparseStrip) {
  const planted::Patch patch{Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX(), 1.0, 1.0, 2000, 0.0};
  std::vector<Vec3> points = planted::cloud_of(patch, 3);
  for (const double y : {-0.8, 0.0, 0.8}) points.emplace_back(1.5, y, 0.0);  // a row beyond a gap
  for (int i = 11; i <= 20; ++i) points.emplace_back(0.1 * i, 0.5, 0.0);     // a line that leads away
  Candidate plane = candidate_of(points, all_of(points.size()));
  keep_dense_part(plane, points, Vec3(0.05, 0.2, 0.0), {0.2, 0.4});
  EXPECT_EQ(plane.members, all_of(2000));
  Candidate whole = candidate_of(points, all_of(2000));
  keep_dense_part(whole, points, Vec3(-1.0, -1.0, 0.0), {0.2, 0.4});
  EXPECT_EQ(whole.members, all_of(2000));
}

TEST(DensePart, NoStripIsTooNarrowAndNoneIsAsked) {
  const std::vector<Vec3> points = tile(0.0, 0.0);
  for (const double step : {1e-9, 0.01, 0.1, 1.0, 1e9}) {
    Candidate plane = candidate_of(points, all_of(points.size()));
    keep_dense_part(plane, points, Vec3(0.5, 0.5, 0.0), {step, 0.4});
    EXPECT_FALSE(plane.members.empty()) << step;
  }
}

}  // namespace
}  // namespace hallway::em
