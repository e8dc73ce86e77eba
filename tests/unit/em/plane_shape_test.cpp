// SPDX-License-Identifier: MIT
#include "em/core/plane_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "patches.hpp"

namespace hallway::em {
namespace {

// Small whole coordinates: exact arithmetic, many ties, equal points and collinear ones.
std::vector<Vec2> lattice_points(std::uint64_t seed, std::size_t count, std::uint64_t size) {
  planted::Numbers numbers(seed);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.emplace_back(static_cast<double>(numbers.below(size)), static_cast<double>(numbers.below(size)));
  }
  return points;
}

std::vector<Vec2> scattered_points(std::uint64_t seed, std::size_t count) {
  planted::Numbers numbers(seed);
  const double angle = numbers.between(0.0, 6.0);
  const double stretch = numbers.between(0.05, 1.0);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 p(numbers.between(-1.0, 1.0), stretch * numbers.between(-1.0, 1.0));
    points.emplace_back(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                        std::sin(angle) * p.x() + std::cos(angle) * p.y());
  }
  return points;
}

// Area of the rectangle around the points whose sides lie at an angle.
double area_at(const std::vector<Vec2>& points, double angle) {
  const Vec2 axis(std::cos(angle), std::sin(angle));
  const Vec2 side(-axis.y(), axis.x());
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
  for (const Vec2& p : points) {
    low = low.cwiseMin(Vec2(axis.dot(p), side.dot(p)));
    high = high.cwiseMax(Vec2(axis.dot(p), side.dot(p)));
  }
  return (high - low).prod();
}

TEST(TightestRectangle, HoldsThePointsAndNoAngleOfASweepIsTighter) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::vector<Vec2> points = scattered_points(seed, 3 + 7 * seed);
    const std::vector<Vec2> hull = convex_hull(points);
    const Rectangle box = tightest_rectangle(hull);
    for (const Vec2& p : points) EXPECT_TRUE(box.contains(p, 1e-12)) << seed;
    EXPECT_GE(box.half_u, box.half_v);
    double swept = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 360; ++step) swept = std::min(swept, area_at(points, step * M_PI / 720.0));
    EXPECT_LE(box.area(), swept * (1.0 + 1e-9) + 1e-12) << seed;
    double over_edges = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
      over_edges = std::min(over_edges, area_at(points, std::atan2(edge.y(), edge.x())));
    }
    EXPECT_NEAR(box.area(), over_edges, 1e-9) << seed;
  }
}

TEST(TightestRectangle, OfLatticePointsWithTies) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::vector<Vec2> points = lattice_points(seed, 12, 5);
    const Rectangle box = tightest_rectangle(convex_hull(points));
    double swept = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 360; ++step) swept = std::min(swept, area_at(points, step * M_PI / 720.0));
    EXPECT_LE(box.area(), swept + 1e-9) << seed;
    for (const Vec2& p : points) EXPECT_TRUE(box.contains(p, 1e-9)) << seed;
  }
}

TEST(TightestRectangle, OfFewPoints) {
  EXPECT_EQ(tightest_rectangle({}).area(), 0.0);
  const std::vector<Vec2> one{{3, 4}};
  EXPECT_EQ(tightest_rectangle(one).centre, Vec2(3, 4));
  const std::vector<Vec2> two{{0, 0}, {3, 4}};
  const Rectangle segment = tightest_rectangle(two);
  EXPECT_DOUBLE_EQ(segment.half_u, 2.5);
  EXPECT_DOUBLE_EQ(segment.half_v, 0.0);
  EXPECT_NEAR(segment.axis.dot(Vec2(0.6, 0.8)), 1.0, 1e-15);
}

TEST(Rectangle, CornersRunCounterClockwise) {
  Rectangle box;
  box.axis = Vec2(0.6, 0.8);
  box.half_u = 2.0;
  box.half_v = 1.0;
  const auto corners = box.corners();
  EXPECT_NEAR(polygon_area(corners), box.area(), 1e-12);
  EXPECT_TRUE(box.contains(corners[2], 1e-12));
  EXPECT_FALSE(box.contains(1.01 * corners[2]));
  EXPECT_TRUE(box.contains(1.01 * corners[2], 0.05));
}

TEST(Orient, PointsTowardsTheOrigin) {
  EXPECT_EQ(orient(Vec3::UnitZ(), Vec3(4, 5, 2)), -Vec3::UnitZ());
  EXPECT_EQ(orient(-Vec3::UnitZ(), Vec3(4, 5, 2)), -Vec3::UnitZ());
  EXPECT_EQ(orient(Vec3::UnitZ(), Vec3(4, 5, -2)), Vec3::UnitZ());
  EXPECT_EQ(orient(-Vec3::UnitY(), Vec3(4, 0, 2)), Vec3::UnitY());
}

TEST(PlaneFrame, IsRightHandedForEveryNormal) {
  planted::Numbers numbers(11);
  for (int i = 0; i < 200; ++i) {
    Vec3 normal = planted::random_direction(numbers);
    if (i < 6) normal = (i % 2 == 0 ? 1.0 : -1.0) * Vec3::Unit(i / 2);
    const PlaneFrame frame = flat_frame(normal, Vec3(1, 2, 3));
    EXPECT_NEAR((frame.u.cross(frame.v) - normal).norm(), 0.0, 1e-12);
    EXPECT_NEAR(frame.u.norm(), 1.0, 1e-12);
    EXPECT_NEAR((frame.flat(frame.lift(Vec2(0.3, -2.0))) - Vec2(0.3, -2.0)).norm(), 0.0, 1e-12);
  }
}

TEST(Outline, OfAPatchIsThePatch) {
  planted::Patch patch = planted::random_patch(21);
  patch.sigma = 0.0;
  patch.points = 4000;
  const std::vector<Vec3> points = planted::cloud_of(patch, 21);
  const Outline outline = outline_of(points, patch.normal, patch.centre);
  const double expected = 4.0 * patch.half_u * patch.half_v;
  EXPECT_LE(outline.rectangle.area(), expected * (1.0 + 1e-9));
  EXPECT_GE(outline.rectangle.area(), 0.97 * expected);
  EXPECT_LE(polygon_area(outline.hull), outline.rectangle.area());
  const auto corners = corners_of(outline);
  EXPECT_GT((corners[1] - corners[0]).cross(corners[2] - corners[1]).dot(patch.normal), 0.0);
  for (const Vec3& p : hull_of(outline)) EXPECT_NEAR(patch.normal.dot(p - patch.centre), 0.0, 1e-9);
  EXPECT_NEAR(density(4000, expected), 4000 / expected, 1e-9);
  EXPECT_EQ(density(4000, 0.0), 0.0);
}

}  // namespace
}  // namespace hallway::em
