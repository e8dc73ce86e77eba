// SPDX-License-Identifier: MIT
#include "slam_plane/core/shift_search.hpp"

#include <gtest/gtest.h>

#include "unit/slam_plane/observations.hpp"

namespace hallway::slam_plane::test {
namespace {

const Gap kGap{1, Vec2(1, 0), 3.0};  // along x

/// Walls before a gap, and the same ones after it displaced by `off` along x.
struct Displaced {
  WallMap map{Options{}};
  std::vector<Index> young;

  Index add(const Vec2& a, const Vec2& b, std::uint32_t epoch, bool corner_a, bool corner_b) {
    const Index w = map.add_wall(epoch, 1);
    map.activate(map.add_submap(Pose2{}, false, epoch));
    map.join(map.active(), w, true);
    const AssociatedObservation s = seen(Pose2{}, a, b, corner_a, corner_b);
    for (int i = 0; i < 6; ++i) map.observe(map.walls[w].active_member, Pose2{}, s, s.corner);
    map.update(w);
    if (epoch > 0) young.push_back(w);
    return w;
  }
  void add_both(const Vec2& a, const Vec2& b, double off, bool corner_a = false, bool corner_b = false) {
    add(a, b, 0, corner_a, corner_b);
    add(a + Vec2(off, 0), b + Vec2(off, 0), 1, corner_a, corner_b);
  }
  bool find(Vec2& step, std::vector<Duplicates>& duplicates) {
    return ShiftSearch(Options{}).find(map, young, kGap, step, duplicates);
  }
};

TEST(ShiftSearch, WallsAcrossTheGapTellTheDisplacement) {
  Displaced d;
  d.add_both({5, 1}, {5, 0}, 0.8, true, true);  // each by its line, and by corners that agree
  d.add_both({6.5, 2}, {6.5, 1}, 0.8, true, true);
  d.add_both({9, -1}, {9, -2}, 0.8, true, true);
  Vec2 step;
  std::vector<Duplicates> duplicates;
  ASSERT_TRUE(d.find(step, duplicates));
  EXPECT_NEAR((step - Vec2(-0.8, 0)).norm(), 0.0, 1e-6);
  EXPECT_EQ(duplicates.size(), 3u);
}

TEST(ShiftSearch, CornersOfWallsAlongTheGapTellItToo) {
  Displaced d;
  d.add_both({2, 2}, {5, 2}, -0.6, false, true);
  d.add_both({7, -2}, {3, -2}, -0.6, true, false);
  d.add_both({8, 1}, {8, 0}, -0.6, true, true);
  d.add_both({9, 3}, {9, 2}, -0.6, true, true);
  Vec2 step;
  std::vector<Duplicates> duplicates;
  ASSERT_TRUE(d.find(step, duplicates));
  EXPECT_NEAR((step - Vec2(0.6, 0)).norm(), 0.0, 1e-6);
  EXPECT_EQ(duplicates.size(), 4u);
}

TEST(ShiftSearch, OneWallWithACornerIsTheOnlyOneThatItCanBe) {
  Displaced d;
  const Index old = d.add({5, 1}, {5, -1}, 0, true, false);
  const Index young = d.add({5.1, 1}, {5.1, 0}, 1, true, false);
  double shift = 0.0;
  EXPECT_EQ(ShiftSearch(Options{}).only_duplicate(d.map, young, kGap, shift), old);
  EXPECT_NEAR(shift, -0.1, 1e-9);
  d.add({6.5, 1}, {6.5, -1}, 0, true, false);  // it may as well be that one
  EXPECT_EQ(ShiftSearch(Options{}).only_duplicate(d.map, young, kGap, shift), kNone);
}

TEST(ShiftSearch, OneWallWithoutACornerTellsNothing) {
  Displaced d;
  d.add({5, 1}, {5, -1}, 0, true, false);
  const Index open = d.add({5.1, 0.9}, {5.1, 0}, 1, false, false);
  const Index elsewhere = d.add({5.1, 0.5}, {5.1, -0.9}, 1, true, false);  // its corner is not there
  double shift = 0.0;
  EXPECT_EQ(ShiftSearch(Options{}).only_duplicate(d.map, open, kGap, shift), kNone);
  EXPECT_EQ(ShiftSearch(Options{}).only_duplicate(d.map, elsewhere, kGap, shift), kNone);
}

TEST(ShiftSearch, TooFewWallsTellNothing) {
  Displaced d;
  d.add_both({5, 1}, {5, 0}, 0.8);
  d.add_both({2, 3}, {8, 3}, 0.8);
  Vec2 step;
  std::vector<Duplicates> duplicates;
  EXPECT_FALSE(d.find(step, duplicates));
}

TEST(ShiftSearch, NarrowGapAsksForLess) {
  Displaced d;
  d.add_both({5, 1}, {5, 0}, 0.2, true, true);
  d.add_both({2, 3}, {4, 3}, 0.2, true, true);
  d.add_both({2, -3}, {8, -3}, 0.2, true, true);
  for (int i = 0; i < 5; ++i) d.add({3.0 + i, 6}, {3.5 + i, 6}, 1, false, false);  // not seen before
  Vec2 step;
  std::vector<Duplicates> duplicates;
  EXPECT_FALSE(d.find(step, duplicates));
  ASSERT_TRUE(ShiftSearch(Options{}).find(d.map, d.young, {1, Vec2(1, 0), 0.3}, step, duplicates));
  EXPECT_NEAR((step - Vec2(-0.2, 0)).norm(), 0.0, 1e-6);
}

TEST(ShiftSearch, WhatRepeatsItselfIsWaitedFor) {
  Displaced d;
  for (int i = 0; i < 4; ++i) d.add({5.0 + i, 1}, {5.0 + i, 0}, 0, false, false);
  for (int i = 1; i < 3; ++i) d.add({5.4 + i, 1}, {5.4 + i, 0}, 1, false, false);
  d.add({5.4, 1}, {5.4, 0}, 1, false, false);
  Vec2 step;
  std::vector<Duplicates> duplicates;
  EXPECT_FALSE(d.find(step, duplicates));
}

TEST(ShiftSearch, CornersThatContradictForbid) {
  Displaced d;
  d.add_both({5, 1}, {5, 0}, 0.8, true, true);
  d.add_both({6.5, 2}, {6.5, 1}, 0.8, true, true);
  d.add_both({9, -1}, {9, -2}, 0.8, true, true);
  for (int i = 0; i < 3; ++i) {  // walls that are longer than those they would be
    d.add({2.0 + i, 4.0 + i}, {2.0 + i, 3.0 + i}, 0, true, true);
    d.add({2.8 + i, 4.5 + i}, {2.8 + i, 2.5 + i}, 1, true, true);
  }
  Vec2 step;
  std::vector<Duplicates> duplicates;
  EXPECT_FALSE(d.find(step, duplicates));
}

TEST(ShiftSearch, DisplacementBeyondTheRangeIsNone) {
  Displaced d;
  d.add_both({5, 1}, {5, 0}, 3.8, true, true);
  d.add_both({6.5, 2}, {6.5, 1}, 3.8, true, true);
  d.add_both({9, -1}, {9, -2}, 3.8, true, true);
  Vec2 step;
  std::vector<Duplicates> duplicates;
  EXPECT_FALSE(d.find(step, duplicates));
}

}  // namespace
}  // namespace hallway::slam_plane::test
