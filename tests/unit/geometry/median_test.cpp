// SPDX-License-Identifier: MIT
#include "geometry/median.hpp"

#include <gtest/gtest.h>

#include "geometry/morton.hpp"
#include "unit/geometry/mixed_points.hpp"

namespace hallway {
namespace {

TEST(Median, IsTheMiddleOfTheSortedValues) {
  std::mt19937_64 random(1);
  for (std::size_t count = 1; count < 40; ++count) {
    std::vector<int> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<int>(random() % 10));
    std::vector<int> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(median(values), sorted[count / 2]);
    EXPECT_EQ(median(values, std::greater<>()), sorted[count - 1 - count / 2]);
  }
}

TEST(Median, OfCoordinatesIsWhereMostPointsAre) {
  std::vector<Vec3> points(11, Vec3(1, 2, 3));
  for (int i = 0; i < 10; ++i) points.push_back(Vec3::Constant(1e9));
  EXPECT_EQ(median_of_coordinates(points), Vec3(1, 2, 3));
}

TEST(MortonCode, HasTheBitsOfItsNumbersInTurn) {
  EXPECT_EQ(morton_code(1, 0, 0), 1u);
  EXPECT_EQ(morton_code(0, 1, 0), 2u);
  EXPECT_EQ(morton_code(0, 0, 1), 4u);
  EXPECT_EQ(morton_code(0b101, 0b011, 0b110), 0b101110011u);
  constexpr std::uint64_t kMost = (1u << 21) - 1;
  EXPECT_EQ(morton_code(kMost, kMost, kMost), (std::uint64_t{1} << 63) - 1);
}

}  // namespace
}  // namespace hallway
