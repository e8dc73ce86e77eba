// SPDX-License-Identifier: MIT
#include "drive/polyline.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/error.hpp"

namespace hallway::drive {
namespace {

const std::vector<Vec3> kCorner{{0.0, 0.0, 5.0}, {2.0, 0.0, 1.0}, {2.0, 0.0, 2.0}, {2.0, 1.0, 0.0}};

TEST(Polyline, PlacesAreByArcLength) {
  const Polyline line(kCorner, false);
  EXPECT_EQ(line.length_m(), 3.0);
  EXPECT_EQ(line.at(0.5), Vec2(0.5, 0.0));
  EXPECT_EQ(line.at(2.0), Vec2(2.0, 0.0));
  EXPECT_EQ(line.at(2.5), Vec2(2.0, 0.5));
  EXPECT_EQ(line.at(4.0), Vec2(2.0, 2.0));
}

TEST(Polyline, ClosedOneGoesRound) {
  const Polyline line({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 1.0, 0.0}}, true);
  EXPECT_EQ(line.length_m(), 4.0);
  EXPECT_EQ(line.at(3.25), Vec2(0.0, 0.75));
  EXPECT_EQ(line.at(9.5), Vec2(1.0, 0.5));
  const Nearest over_the_seam = line.nearest({0.5, -0.1}, 3.75, 4.75);
  EXPECT_NEAR(over_the_seam.along_m, 4.5, 1e-15);
  EXPECT_NEAR(over_the_seam.distance_m, 0.1, 1e-15);
  EXPECT_NEAR(line.nearest({0.9, 0.5}, 12.5, 13.6).along_m, 13.5, 1e-14);
}

TEST(Polyline, NearestIsWithinItsBounds) {
  const Polyline line(kCorner, false);
  EXPECT_EQ(line.nearest({1.0, 0.5}, 0.0, 3.0).along_m, 1.0);
  EXPECT_EQ(line.nearest({1.0, 0.5}, 1.5, 3.0).along_m, 1.5);
  EXPECT_EQ(line.nearest({1.0, 0.5}, 0.0, 0.5).along_m, 0.5);
  EXPECT_EQ(line.nearest({1.9, 0.8}, 0.0, 9.0).along_m, 2.8);
  EXPECT_EQ(line.nearest({2.0, 7.0}, 0.0, 9.0).along_m, 3.0);
  EXPECT_EQ(line.nearest({2.0, 7.0}, 3.0, 9.0).distance_m, 6.0);
}

TEST(Polyline, NeedsTwoDifferentFinitePoints) {
  EXPECT_THROW(Polyline({}, false), Error);
  EXPECT_THROW(Polyline({}, true), Error);
  EXPECT_THROW(Polyline({{1.0, 1.0, 0.0}, {1.0, 1.0, 3.0}}, true), Error);
  EXPECT_THROW(Polyline({{1.0, 1.0, 0.0}, {std::numeric_limits<double>::infinity(), 1.0, 0.0}}, false),
               Error);
}

}  // namespace
}  // namespace hallway::drive
