// SPDX-License-Identifier: MIT
#include "base/unit_quaternion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace hallway {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(UnitQuaternion, LengthsWithinTheToleranceAreRotations) {
  for (const double length : {1.0, 1.0 + 0.9e-6, 1.0 - 0.9e-6}) {
    EXPECT_TRUE(is_unit_quaternion(std::array{0.5 * length, -0.5 * length, 0.5 * length, 0.5 * length}));
  }
  for (const double length : {0.0, 1.0 + 1.1e-6, 1.0 - 1.1e-6, 2.0, 1e200}) {
    EXPECT_FALSE(is_unit_quaternion(std::array{0.0, length, 0.0, 0.0}));
  }
}

TEST(UnitQuaternion, FilesMayHaveRoundedNumbers) {
  EXPECT_TRUE(is_unit_quaternion(std::array{0.71, 0.0, 0.0, 0.71}, kUnitFileTolerance));
  EXPECT_FALSE(is_unit_quaternion(std::array{0.7, 0.0, 0.0, 0.75}, kUnitFileTolerance));
  EXPECT_FALSE(is_unit_quaternion(std::array{0.71, 0.0, 0.0, 0.71}));
}

TEST(UnitQuaternion, WhatIsNotFiniteIsNone) {
  for (const double bad : {kNan, kInfinite, -kInfinite}) {
    for (std::size_t i = 0; i < 4; ++i) {
      std::array q{1.0, 0.0, 0.0, 0.0};
      q[i] = bad;
      EXPECT_FALSE(is_unit_quaternion(q, kUnitFileTolerance));
      EXPECT_FALSE(std::isfinite(quaternion_length(q)));
      EXPECT_FALSE(is_pose(std::array{0.0, 0.0, 0.0}, q));
    }
    EXPECT_FALSE(is_pose(std::array{0.0, bad, 0.0}, std::array{1.0, 0.0, 0.0, 0.0}));
  }
  EXPECT_TRUE(is_pose(std::array{1e300, 0.0, 0.0}, std::array{0.0, 0.0, 0.0, -1.0}));
}

}  // namespace
}  // namespace hallway
