// SPDX-License-Identifier: MIT
#include "geometry/convex2.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hallway {
namespace {

/// The oracle: a point is a corner of the hull unless it lies within a triangle of others or between two of them.
bool is_corner(const std::vector<Vec2>& points, std::size_t i) {
  const Vec2& p = points[i];
  for (const Vec2& a : points) {
    for (const Vec2& b : points) {
      if (a == p || b == p) continue;
      if (cross(a - p, b - p) == 0.0 && (a - p).dot(b - p) < 0.0) return false;
      for (const Vec2& c : points) {
        if (c == p) continue;
        if (cross(b - a, p - a) > 0.0 && cross(c - b, p - b) > 0.0 && cross(a - c, p - c) > 0.0) return false;
      }
    }
  }
  return true;
}

/// Small whole coordinates: exact arithmetic, many ties, equal points and collinear ones.
std::vector<Vec2> lattice_points(std::uint64_t seed, std::size_t count, std::uint64_t size) {
  std::mt19937_64 numbers(seed);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<double>(numbers() % size);
    points.emplace_back(x, static_cast<double>(numbers() % size));
  }
  return points;
}

Convex rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(ConvexHull, HasExactlyTheCornersThatBruteForceFinds) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::vector<Vec2> points = lattice_points(seed, 3 + seed % 12, 2 + seed % 6);
    std::vector<Vec2> expected;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (is_corner(points, i) && std::find(expected.begin(), expected.end(), points[i]) == expected.end()) {
        expected.push_back(points[i]);
      }
    }
    const std::vector<Vec2> hull = convex_hull(points);
    ASSERT_EQ(hull.size(), expected.size()) << seed;
    for (const Vec2& p : expected) EXPECT_NE(std::find(hull.begin(), hull.end(), p), hull.end()) << seed;
    for (std::size_t i = 0; hull.size() > 2 && i < hull.size(); ++i) {
      const Vec2& a = hull[i];
      const Vec2& b = hull[(i + 1) % hull.size()];
      EXPECT_GT(cross(b - a, hull[(i + 2) % hull.size()] - b), 0.0) << seed;
    }
  }
}

TEST(ConvexHull, OfManyPointsTurnsLeftAtItsOwnPointsAndHoldsAll) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const std::vector<Vec2> points = lattice_points(seed, 30 + 20 * seed, 3 + 7 * seed);
    const std::vector<Vec2> hull = convex_hull(points);
    ASSERT_GE(hull.size(), 3u);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec2& a = hull[i];
      const Vec2& b = hull[(i + 1) % hull.size()];
      EXPECT_NE(std::find(points.begin(), points.end(), a), points.end());
      EXPECT_GT(cross(b - a, hull[(i + 2) % hull.size()] - b), 0.0);
      for (const Vec2& p : points) EXPECT_GE(cross(b - a, p - a), 0.0);
    }
  }
}

TEST(ConvexHull, OfNothingPointsAndLines) {
  std::vector<Vec2> line;
  for (int i = 0; i < 100; ++i) line.emplace_back(i, 2 * i);
  EXPECT_EQ(convex_hull(line), (std::vector<Vec2>{{0, 0}, {99, 198}}));
  EXPECT_EQ(convex_hull(std::vector<Vec2>(100, Vec2(3, 4))), (std::vector<Vec2>{{3, 4}}));
  EXPECT_TRUE(convex_hull({}).empty());
  EXPECT_EQ(convex_hull({{1, 2}, {1, 2}, {1, 2}}).size(), 1u);
  EXPECT_EQ(convex_hull({{0, 0}, {1, 1}, {3, 3}, {2, 2}}), (std::vector<Vec2>{{0, 0}, {3, 3}}));
}

TEST(PolygonArea, OfASquareEitherWayRound) {
  const std::vector<Vec2> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_DOUBLE_EQ(polygon_area(square), 4.0);
  EXPECT_DOUBLE_EQ(polygon_area(std::vector<Vec2>(square.rbegin(), square.rend())), -4.0);
  EXPECT_DOUBLE_EQ(polygon_area(std::vector<Vec2>{{0, 0}, {1, 1}}), 0.0);
}

TEST(Convex, TheWidthIsAcrossTheNarrowWay) {
  EXPECT_NEAR(width(rectangle(0, 0, 3, 0.5)), 0.5, 1e-12);
  EXPECT_NEAR(width({{0, 0}, {4, 0}, {0, 3}}), 2.4, 1e-12);
  EXPECT_DOUBLE_EQ(width({{0, 0}, {5, 0}, {5, 1}, {0, 1}}), 1.0);
  EXPECT_EQ(width({{0, 0}, {5, 0}}), 0.0);
}

TEST(Convex, ClippingKeepsWhatLiesBelowTheLine) {
  const Convex square = rectangle(0, 0, 2, 2);
  EXPECT_EQ(clip(square, Vec2::UnitX(), 3.0), square);
  EXPECT_TRUE(clip(square, Vec2::UnitX(), -1.0).empty());
  EXPECT_DOUBLE_EQ(polygon_area(clip(square, Vec2::UnitX(), 0.5)), 1.0);
  EXPECT_DOUBLE_EQ(polygon_area(clip(square, Vec2(1, 1), 2.0)),
                   2.0);  // along a diagonal, through two corners
  EXPECT_EQ(clip(square, Vec2(1, 1), 2.0).size(), 3u);
}

TEST(PlaneAxes, PointsGoThereAndBack) {
  const Vec3 normal = Vec3(1.0, -2.0, 0.5).normalized();
  const PlaneAxes axes(normal);
  EXPECT_NEAR((axes.u.cross(axes.v) - normal).norm(), 0.0, 1e-12);
  const Vec3 p(0.3, 4.0, -2.0);
  EXPECT_NEAR((axes.lift(axes.flat(p), normal.dot(p)) - p).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace hallway
