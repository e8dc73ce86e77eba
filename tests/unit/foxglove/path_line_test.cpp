// SPDX-License-Identifier: MIT
#include "foxglove/path_line.hpp"

#include <gtest/gtest.h>

namespace hallway::foxglove {
namespace {

std::size_t points_of(const std::vector<Line>& lines) {
  std::size_t points = 0;
  for (const Line& line : lines) points += line.points.size();
  return points;
}

TEST(PathLine, ShowsItsPositionsInOrder) {
  PathLine path;
  for (std::uint32_t i = 0; i < 5; ++i) path.add(i, Vec3(i, 0, 0));
  const std::vector<Line> lines = path.show(3.0, {0, 1, 0});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].width_px, 3.0);
  EXPECT_EQ(lines[0].colour.green, 1.0);
  ASSERT_EQ(lines[0].points.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(lines[0].points[i].x(), static_cast<double>(i));
}

TEST(PathLine, IsBrokenWhereAnIterationIsMissing) {
  PathLine path;
  for (const std::uint32_t i : {3u, 4u, 6u, 8u, 9u, 10u}) path.add(i, Vec3(i, 0, 0));
  const std::vector<Line> lines = path.show(1.0, {});
  ASSERT_EQ(lines.size(), 2u) << "one point alone is no line";
  EXPECT_EQ(lines[0].points.size(), 2u);
  EXPECT_EQ(lines[1].points.size(), 3u);
}

TEST(PathLine, HasNewsUntilItIsShown) {
  PathLine path;
  EXPECT_FALSE(path.has_news());
  path.add(0, Vec3::Zero());
  EXPECT_TRUE(path.has_news());
  path.show(1.0, {});
  EXPECT_FALSE(path.has_news());
  path.add(1, Vec3::Zero());
  EXPECT_TRUE(path.has_news());
}

TEST(PathLine, AllThatIsShownIsAFewTimesThePath) {
  PathLine path;
  std::size_t shown = 0;
  std::size_t longest_wait = 0;
  std::size_t waited = 0;
  constexpr std::uint32_t kPoints = 20'000;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    path.add(i, Vec3::Zero());
    longest_wait = std::max(longest_wait, ++waited);
    if (!path.is_due()) continue;
    waited = 0;
    shown += points_of(path.show(1.0, {}));
  }
  EXPECT_LE(shown, 17u * kPoints);
  EXPECT_LE(longest_wait, kPoints / 16);
  EXPECT_GT(shown, kPoints) << "it is shown on the way";
}

}  // namespace
}  // namespace hallway::foxglove
