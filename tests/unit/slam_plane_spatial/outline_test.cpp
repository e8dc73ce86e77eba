// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/outline.hpp"

#include <gtest/gtest.h>

namespace hallway::slam_plane::spatial {
namespace {

Convex rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(SpatialPolygon, OverlapIsWhatBothHave) {
  EXPECT_NEAR(overlap_area(rectangle(0, 0, 2, 2), rectangle(1, 1, 3, 3)), 1.0, 1e-12);
  EXPECT_EQ(overlap_area(rectangle(0, 0, 1, 1), rectangle(2, 0, 3, 1)), 0.0);
  EXPECT_NEAR(overlap_area(rectangle(0, 0, 4, 4), {{1, 1}, {3, 1}, {2, 3}}), 2.0, 1e-12);
}

TEST(SpatialPolygon, DistanceIsThatOfTheNearestPoints) {
  EXPECT_EQ(distance(rectangle(0, 0, 2, 2), rectangle(1, 1, 3, 3)), 0.0);
  EXPECT_NEAR(distance(rectangle(0, 0, 1, 1), rectangle(1.5, 0.2, 3, 0.8)), 0.5, 1e-12);
  EXPECT_NEAR(distance(rectangle(0, 0, 1, 1), rectangle(4, 5, 6, 6)), 5.0, 1e-12);
}

TEST(SpatialPolygon, SimplifyingDropsTheFlattestCorners) {
  Convex polygon{{0, 0}, {1, -0.01}, {2, 0}, {2, 2}, {0, 2}};
  simplify(polygon, 4);
  EXPECT_EQ(polygon.size(), 4u);
  EXPECT_DOUBLE_EQ(area(polygon), 4.0);
}

}  // namespace
}  // namespace hallway::slam_plane::spatial
