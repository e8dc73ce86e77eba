// SPDX-License-Identifier: MIT
#include "slam_plane/core/duplicate_finder.hpp"

#include <gtest/gtest.h>

#include "unit/slam_plane/observations.hpp"

namespace hallway::slam_plane::test {
namespace {

constexpr std::uint64_t kLater = 1000;

/// Two parts of one wall, from x = 1 to `end` and from `begin` to 9, each seen 30 times; nobody saw an end between.
struct Parts {
  WallMap map{Options{}};

  Parts(double end, double begin, std::uint32_t hidden) {
    map.activate(map.add_submap(Pose2{}, false, 0));
    add({1, 2}, {end, 2});
    add({begin, 2}, {9, 2});
    map.walls[0].hidden[kEndB] = map.walls[1].hidden[kEndA] = hidden;
  }
  void add(const Vec2& a, const Vec2& b) {
    const Index w = map.add_wall(0, 1);
    map.join(map.active(), w, true);
    const AssociatedObservation s = seen(Pose2{}, a, b);
    for (int i = 0; i < 30; ++i) map.observe(map.walls[w].active_member, Pose2{}, s, s.corner);
    map.update(w);
  }
  Index duplicate(std::uint64_t iteration = kLater) const {
    return DuplicateFinder(Options{}).duplicate_of(map, 1, 0, iteration);
  }
};

TEST(DuplicateFinder, PartsWithSomethingInFrontOfTheRestAreOne) {
  EXPECT_EQ(Parts(4.0, 4.5, 3).duplicate(), 0u);
}

TEST(DuplicateFinder, PartsThatTheViewCutAreTwo) {
  EXPECT_EQ(Parts(4.0, 4.5, 0).duplicate(), kNone);
}

TEST(DuplicateFinder, PartsThatOverlapAreOne) {
  EXPECT_EQ(Parts(4.5, 4.2, 0).duplicate(), 0u);
}

TEST(DuplicateFinder, PartsFarFromEachOtherAreTwo) {
  EXPECT_EQ(Parts(4.0, 5.5, 3).duplicate(), kNone);
}

TEST(DuplicateFinder, PartsInViewHaveTimeToShowTheirEnds) {
  EXPECT_EQ(Parts(4.0, 4.5, 3).duplicate(10), kNone);
}

TEST(DuplicateFinder, WhatMovesIsNoTwin) {
  Parts parts(4.5, 4.2, 0);
  parts.map.walls[0].is_dynamic = true;
  EXPECT_EQ(parts.duplicate(), kNone);
}

}  // namespace
}  // namespace hallway::slam_plane::test
