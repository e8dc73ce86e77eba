// SPDX-License-Identifier: MIT
#include "trace/triangle_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "unit/trace/shapes.hpp"

namespace hallway::trace {
namespace {

void expect_partition(const Groups& groups, std::size_t count, std::uint32_t most) {
  ASSERT_FALSE(groups.begin.empty());
  EXPECT_EQ(groups.begin.front(), 0u);
  EXPECT_EQ(groups.begin.back(), count);
  for (std::size_t g = 0; g + 1 < groups.begin.size(); ++g) {
    ASSERT_GT(groups.begin[g + 1], groups.begin[g]);
    ASSERT_LE(groups.begin[g + 1] - groups.begin[g], most);
  }
  std::vector<std::uint32_t> items = groups.items;
  std::sort(items.begin(), items.end());
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_EQ(items, all);
}

TEST(GroupBoxes, PutsEveryBoxIntoOneSmallGroup) {
  test::Draw draw(41);
  for (const std::size_t count : {1u, 7u, 8u, 9u, 100u, 3000u}) {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 at = draw.point(100.0);
      boxes.push_back(Box(at).extend(Vec3(at + Vec3::Constant(draw.uniform(0.0, 30.0)))));
    }
    for (const std::uint32_t most : {1u, 8u}) expect_partition(group_boxes(boxes, most), count, most);
  }
}

TEST(GroupBoxes, DividesBoxesThatAreAllInOnePlace) {
  expect_partition(group_boxes(std::vector<Box>(1000, Box(Vec3(1, 2, 3))), 8), 1000, 8);
}

TEST(GroupBoxes, DividesBoxesAtEverSmallerDistances) {
  std::vector<Box> boxes;
  for (double at = 1e7; at > 1e-300; at *= 0.5) boxes.emplace_back(Vec3(at, 0, 0));
  const std::size_t count = boxes.size();
  expect_partition(group_boxes(boxes, 1), count, 1);
}

TEST(GroupBoxes, KeepsClumpsApart) {
  std::vector<Box> boxes;
  for (int i = 0; i < 24; ++i) boxes.emplace_back(Vec3(100.0 * (i % 3), 0.01 * i, 0));
  const Groups groups = group_boxes(boxes, 8);
  ASSERT_EQ(groups.begin.size(), 4u);
  for (std::size_t g = 0; g < 3; ++g) {
    for (std::uint32_t i = groups.begin[g]; i < groups.begin[g + 1]; ++i) {
      EXPECT_EQ(groups.items[i] % 3, groups.items[groups.begin[g]] % 3);
    }
  }
}

TEST(GroupBoxes, OfNothingIsNothing) {
  expect_partition(group_boxes({}, 8), 0, 8);
}

}  // namespace
}  // namespace hallway::trace
