// SPDX-License-Identifier: MIT
#include "geom/plane.hpp"

#include <gtest/gtest.h>

#include "geom/box.hpp"

namespace hallway {
namespace {

TEST(Plane, DistanceIsPositiveWhereTheNormalPoints) {
  const Plane plane{Vec3(0.6, 0.8, 0.0), 2.0};
  EXPECT_DOUBLE_EQ(plane.distance(5.0 * plane.normal), 3.0);
  EXPECT_DOUBLE_EQ(plane.distance(Vec3::Zero()), -2.0);
}

TEST(Plane, DistanceIsTheSameAlongThePlane) {
  const Plane plane{Vec3(0.6, 0.8, 0.0), 2.0};
  const Vec3 along(-0.8, 0.6, 7.0);
  EXPECT_NEAR(plane.distance(Vec3(1, 2, 3) + along), plane.distance(Vec3(1, 2, 3)), 1e-14);
}

TEST(Box, IsEmptyUntilExtended) {
  Box box;
  EXPECT_TRUE(box.isEmpty());
  box.extend(Vec3(1, 2, 3));
  EXPECT_FALSE(box.isEmpty());
  EXPECT_TRUE(box.contains(Vec3(1, 2, 3)));
}

}  // namespace
}  // namespace hallway
