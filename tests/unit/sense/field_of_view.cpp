// SPDX-License-Identifier: MIT
#include "sense/field_of_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hallway::sense {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

Vec3 at_angles(double azimuth_deg, double elevation_deg, double range_m = 10.0) {
  const double a = azimuth_deg * kDegree;
  const double e = elevation_deg * kDegree;
  return range_m * Vec3(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
}

TEST(FieldOfView, IsAPyramidBelow180Degrees) {
  const FieldOfView view(90 * kDegree, 60 * kDegree, 0.0, 100.0);
  const double up = std::tan(30 * kDegree);
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(view.contains({10, sign * 9.999, 0}));
    EXPECT_FALSE(view.contains({10, sign * 10.001, 0}));
    EXPECT_TRUE(view.contains({10, 0, sign * (10 * up - 0.001)}));
    EXPECT_FALSE(view.contains({10, 0, sign * (10 * up + 0.001)}));
    EXPECT_TRUE(view.contains({10, 9.999, sign * (10 * up - 0.001)})) << "the corner belongs to it";
  }
}

TEST(FieldOfView, HasNothingBehindAPyramid) {
  const FieldOfView view(179 * kDegree, 179 * kDegree, 0.0, 100.0);
  EXPECT_FALSE(view.contains({-1, 0, 0}));
  EXPECT_FALSE(view.contains({0, 0, 0})) << "the sensor's own place";
  EXPECT_FALSE(view.contains({0, 1, 0}));
}

TEST(FieldOfView, EndsAtItsRanges) {
  const FieldOfView view(90 * kDegree, 90 * kDegree, 2.0, 5.0);
  EXPECT_FALSE(view.contains({1.999, 0, 0}));
  EXPECT_TRUE(view.contains({2, 0, 0}));
  EXPECT_TRUE(view.contains({5, 0, 0}));
  EXPECT_FALSE(view.contains({5.001, 0, 0}));
  EXPECT_TRUE(view.contains({4, 3, 0}));
  EXPECT_FALSE(view.contains({4.5, 3, 0})) << "range is the distance, not the depth";
}

TEST(FieldOfView, SeesBehindFromMoreThan180Degrees) {
  const FieldOfView view(270 * kDegree, 40 * kDegree, 0.0, 100.0);
  EXPECT_TRUE(view.contains(at_angles(134, 0)));
  EXPECT_TRUE(view.contains(at_angles(-134, 0)));
  EXPECT_FALSE(view.contains(at_angles(136, 0)));
  EXPECT_FALSE(view.contains(at_angles(-136, 0)));
  EXPECT_TRUE(view.contains(at_angles(120, 19.9)));
  EXPECT_FALSE(view.contains(at_angles(120, 20.1))) << "elevation limits all round alike";
}

TEST(FieldOfView, SeesAllRoundWith360Degrees) {
  for (const double turn : {2.0 * kPi, 360.0 * kDegree, 2.0 * kPi - 1e-12}) {
    const FieldOfView view(turn, 30 * kDegree, 0.0, 100.0);
    for (int azimuth = -180; azimuth <= 180; ++azimuth) {
      ASSERT_TRUE(view.contains(at_angles(azimuth, 14.9)));
      ASSERT_FALSE(view.contains(at_angles(azimuth, -15.1)));
    }
  }
}

TEST(FieldOfView, SeesAWholeSphere) {
  const FieldOfView view(2.0 * kPi, kPi, 0.0, 100.0);
  for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(-1, 0, 0), Vec3(-1, -1e-9, -5)}) {
    EXPECT_TRUE(view.contains(direction)) << direction.transpose();
  }
}

TEST(FieldOfView, MayBeAnUprightFan) {
  const FieldOfView view(10 * kDegree, kPi, 0.0, 100.0);
  EXPECT_TRUE(view.contains(at_angles(4.9, 80)));
  EXPECT_FALSE(view.contains(at_angles(5.1, 80)));
  EXPECT_FALSE(view.contains(at_angles(180, 0)));
}

}  // namespace
}  // namespace hallway::sense
