// SPDX-License-Identifier: MIT
#include "sense/landmark_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "bsp/point_location.hpp"
#include "support/errors.hpp"
#include "support/scattered_points.hpp"
#include "unit/sense/rooms.hpp"

namespace hallway::sense {
namespace {

using test::scattered;

void expect_each_landmark_once(const LandmarkIndex& index, const std::vector<Vec3>& landmarks) {
  std::vector<std::uint32_t> numbers(index.numbers().begin(), index.numbers().end());
  std::sort(numbers.begin(), numbers.end());
  std::vector<std::uint32_t> all(landmarks.size());
  std::iota(all.begin(), all.end(), 0u);
  ASSERT_EQ(numbers, all);
  std::uint32_t next = 0;
  for (const LandmarkIndex::Block& block : index.blocks()) {
    ASSERT_EQ(block.first, next);
    ASSERT_GE(block.count, 1u);
    ASSERT_LE(block.count, LandmarkIndex::kBlockSize);
    next += block.count;
    for (std::uint32_t i = block.first; i < next; ++i) {
      ASSERT_EQ(index.points()[i], landmarks[index.numbers()[i]]);
      ASSERT_TRUE(block.box.contains(index.points()[i]));
    }
  }
  ASSERT_EQ(next, landmarks.size());
}

TEST(LandmarkIndex, HasEachLandmarkOnce) {
  for (const std::uint64_t count : {0u, 1u, 128u, 129u, 5000u}) {
    const std::vector<Vec3> landmarks = scattered(count, {-5, -6, -1}, {125, 6, 4});
    expect_each_landmark_once(LandmarkIndex(landmarks), landmarks);
    const test::Rooms rooms(12);
    expect_each_landmark_once(LandmarkIndex(landmarks, rooms.tree, rooms.visible), landmarks);
  }
}

TEST(LandmarkIndex, HasSmallBlocks) {
  const std::vector<Vec3> landmarks = scattered(100000, {0, 0, 0}, {100, 100, 1});
  const LandmarkIndex index(landmarks);
  double area = 0.0;
  for (const auto& block : index.blocks()) area += block.box.sizes().x() * block.box.sizes().y();
  EXPECT_LT(area, 3.0 * 100.0 * 100.0) << "blocks overlap little";
}

TEST(LandmarkIndex, LooksOnlyAtRoomsThatMayBeSeen) {
  const test::Rooms rooms(12);
  const std::vector<Vec3> landmarks = scattered(20000, {0.01, -3.99, 0.01}, {119.99, 3.99, 2.99});
  const LandmarkIndex index(landmarks, rooms.tree, rooms.visible);
  std::vector<std::uint32_t> blocks;
  index.blocks_from({45, 0, 1.5}, blocks);  // in the room 4, which sees 3 to 5
  EXPECT_TRUE(std::is_sorted(blocks.begin(), blocks.end()));
  std::set<std::uint32_t> reached;
  for (const std::uint32_t b : blocks) {
    for (std::uint32_t i = 0; i < index.blocks()[b].count; ++i) {
      reached.insert(index.numbers()[index.blocks()[b].first + i]);
    }
  }
  std::size_t elsewhere = 0;
  for (std::uint32_t i = 0; i < landmarks.size(); ++i) {
    const double x = landmarks[i].x();
    if (x > 30.0 && x < 60.0) {
      EXPECT_TRUE(reached.contains(i));
    } else if (reached.contains(i)) {
      ++elsewhere;  // next to a plane of the tree
    }
  }
  EXPECT_LT(elsewhere, 20u);
}

TEST(LandmarkIndex, LooksEverywhereFromOutside) {
  const test::Rooms rooms(6);
  const LandmarkIndex index(scattered(3000, {0, -4, 0}, {60, 4, 3}), rooms.tree, rooms.visible);
  std::vector<std::uint32_t> blocks;
  for (const Vec3& viewpoint : {Vec3(-1, 0, 1), Vec3(30, 4.5, 1), Vec3(30, 4.0, 1), Vec3(1e6, 0, 0)}) {
    index.blocks_from(viewpoint, blocks);
    EXPECT_EQ(blocks.size(), index.blocks().size());
  }
}

TEST(LandmarkIndex, AlwaysLooksAtLandmarksOutsideAndOnPlanes) {
  const test::Rooms rooms(6);
  const std::vector<Vec3> landmarks = {{-3, 0, 1}, {30, 0, 1}, {45, 4, 1}, {55, 0, 1}};
  const LandmarkIndex index(landmarks, rooms.tree, rooms.visible);
  std::vector<std::uint32_t> blocks;
  index.blocks_from({5, 0, 1}, blocks);
  std::vector<std::uint32_t> reached;
  for (const std::uint32_t b : blocks) {
    for (std::uint32_t i = 0; i < index.blocks()[b].count; ++i) {
      reached.push_back(index.numbers()[index.blocks()[b].first + i]);
    }
  }
  std::sort(reached.begin(), reached.end());
  EXPECT_EQ(reached, (std::vector<std::uint32_t>{0, 1, 2}))
      << "all but the one in the middle of the last room";
}

TEST(LandmarkIndex, SeesTheRowsOfBothRoomsFromADoor) {
  const test::Rooms rooms(12);
  const std::vector<Vec3> landmarks = scattered(2000, {0.01, -3.99, 0.01}, {119.99, 3.99, 2.99});
  const LandmarkIndex index(landmarks, rooms.tree, rooms.visible);
  std::vector<std::uint32_t> left;
  std::vector<std::uint32_t> right;
  std::vector<std::uint32_t> between;
  index.blocks_from({29, 0, 1}, left);
  index.blocks_from({31, 0, 1}, right);
  index.blocks_from({30, 0, 1}, between);
  std::vector<std::uint32_t> both;
  std::set_union(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(both));
  EXPECT_EQ(between, both);
  EXPECT_GT(between.size(), left.size());
}

TEST(LandmarkIndex, RefusesVisibleSetsOfAnotherTree) {
  const test::Rooms six(6);
  const test::Rooms seven(7);
  const auto error = test::error_of([&] { LandmarkIndex({}, six.tree, seven.visible); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kInternal);
}

}  // namespace
}  // namespace hallway::sense
