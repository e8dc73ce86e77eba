// SPDX-License-Identifier: MIT
#include "geometry/kd_tree.hpp"

#include <gtest/gtest.h>

#include <random>

#include "unit/geometry/mixed_points.hpp"

namespace hallway {
namespace {

using test::all_distances2;
using test::mixed_points;
using test::somewhere;

TEST(KdTree, NearestIsThatOfALoopOverAllPoints) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::vector<Vec3> points = mixed_points(seed);
    const KdTree tree(points);
    std::mt19937_64 random(seed + 100);
    for (int i = 0; i < 200; ++i) {
      const Vec3 place = somewhere(random);
      const double nearest2 = all_distances2(points, place).front();
      const auto found = tree.nearest(place, 1.0);
      ASSERT_EQ(found.has_value(), nearest2 <= 1.0);
      if (!found) continue;
      EXPECT_EQ(found->distance2, nearest2);
      EXPECT_EQ((points[found->index] - place).squaredNorm(), nearest2);
    }
  }
}

TEST(KdTree, TheNearestFewAreThoseOfALoopOverAllPoints) {
  const std::vector<Vec3> points = mixed_points(7);
  const KdTree tree(points);
  std::mt19937_64 random(8);
  std::vector<Neighbour> found;
  for (const std::size_t count : {1u, 8u, 20u, 700u}) {
    for (int i = 0; i < 30; ++i) {
      const Vec3 place = somewhere(random);
      const std::vector<double> expected = all_distances2(points, place);
      tree.nearest(place, count, found);
      ASSERT_EQ(found.size(), std::min(count, points.size()));
      for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].distance2, expected[k]);
    }
  }
}

TEST(KdTree, AnswersDoNotDependOnTheOrderOfPoints) {
  const std::vector<Vec3> points = mixed_points(9);
  std::vector<Vec3> other = points;
  std::shuffle(other.begin(), other.end(), std::mt19937_64(10));
  const KdTree tree(points), other_tree(other);
  std::vector<Neighbour> found, other_found;
  for (double x = -1.0; x < 7.0; x += 0.5) {
    const Vec3 place(x, 2.5, 0.5);  // as far from several points of the lattice
    EXPECT_EQ(points[tree.nearest(place, 5.0)->index], other[other_tree.nearest(place, 5.0)->index]);
    tree.nearest(place, 9, found);
    other_tree.nearest(place, 9, other_found);
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_EQ(points[found[k].index], other[other_found[k].index]);
  }
}

TEST(KdTree, OfNothingAndOfOnePoint) {
  std::vector<Neighbour> found;
  const KdTree empty{std::vector<Vec3>()};
  EXPECT_FALSE(empty.nearest(Vec3::Zero(), 1e9));
  empty.nearest(Vec3::Zero(), 3, found);
  EXPECT_TRUE(found.empty());
  const KdTree one{std::vector<Vec3>{Vec3(1, 0, 0)}};
  EXPECT_TRUE(one.nearest(Vec3::Zero(), 1.0)) << "the bound is included";
  EXPECT_FALSE(one.nearest(Vec3::Zero(), 0.999));
}

TEST(KdTree, TheRegionsPointsAreThoseThatItContains) {
  struct Ball {
    Vec3 centre;
    double radius;
    bool contains(const Vec3& p) const { return (p - centre).norm() <= radius; }
    bool touches(const Vec3& middle, const Vec3& half) const {
      return ((middle - centre).cwiseAbs() - half).cwiseMax(0.0).norm() <= radius;
    }
  };
  const std::vector<Vec3> points = mixed_points(3);
  const KdTree tree(points);
  std::mt19937_64 random(4);
  for (int i = 0; i < 100; ++i) {
    const Ball ball{somewhere(random), 2.0};
    std::vector<std::uint32_t> expected;
    for (std::uint32_t k = 0; k < points.size(); ++k) {
      if (ball.contains(points[k])) expected.push_back(k);
    }
    EXPECT_EQ(tree.within(ball), expected);
  }
}

}  // namespace
}  // namespace hallway
