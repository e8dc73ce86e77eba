// SPDX-License-Identifier: MIT
#include "geom/box_tree.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/scattered_points.hpp"

namespace hallway {
namespace {

using test::scattered;

TEST(BoxTree, FindsWhatTouches) {
  const std::vector<Vec3> corners = scattered(2000, {0, 0, 0}, {50, 50, 5});
  const std::vector<Vec3> sizes = scattered(2000, {0, 0, 0}, {3, 1, 2});
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    boxes.push_back(i % 50 == 0 ? Box() : Box(corners[i], Vec3(corners[i] + sizes[i])));
  }
  const BoxTree tree(boxes);
  std::vector<std::uint32_t> found;
  std::size_t total = 0;
  for (std::size_t i = 0; i < 500; ++i) {
    const Box wanted(Vec3(corners[i] + Vec3::Constant(0.3)),
                     Vec3(corners[i] + sizes[i] + Vec3::Constant(0.3)));
    tree.find(wanted, found);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t k = 0; k < boxes.size(); ++k) {
      if (!boxes[k].isEmpty() && boxes[k].intersects(wanted)) expected.push_back(k);
    }
    ASSERT_EQ(found, expected);
    total += found.size();
  }
  EXPECT_GT(total, 500u);
  BoxTree(std::vector<Box>{}).find(Box(Vec3::Zero()), found);
  EXPECT_TRUE(found.empty());
  BoxTree(std::vector<Box>(100, Box(Vec3(1, 1, 1)))).find(Box(Vec3(1, 1, 1)), found);
  EXPECT_EQ(found.size(), 100u);
}

}  // namespace
}  // namespace hallway
