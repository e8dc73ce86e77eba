// SPDX-License-Identifier: MIT
#include "slam_plane/core/wall_map.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "unit/slam_plane/observations.hpp"

namespace hallway::slam_plane::test {
namespace {

const Vec2 kA(5, 2), kB(5, -3);

void observe(WallMap& map, Index w, const Pose2& T_map_robot, const Vec2& a, const Vec2& b, bool corners) {
  if (map.walls[w].active_member == kNone) map.join(map.active(), w, false);
  const AssociatedObservation s = seen(T_map_robot, a, b, corners, corners);
  const Pose2 T = map.submaps[map.active()].T_map_submap.inverse() * T_map_robot;
  map.observe(map.walls[w].active_member, T, s, s.corner);
  map.update(w);
}

/// Observations of one wall with noise, in three submaps, taken for the walls that `which` says.
void fill(WallMap& map, const std::vector<Index>& which) {
  const Random random(3, stream_id("wall_map_test"));
  for (std::uint32_t s = 0; s < 3; ++s) {
    map.activate(map.add_submap(Pose2::at({0.5 * s, 0.1 * s}, 0.2 * s), false, 0));
    for (std::uint32_t i = 0; i < 8; ++i) {
      const Vec2 off(0.02 * random.normal(10 * s + i, 0), 0.005 * random.normal(10 * s + i, 1));
      observe(map, which[(s + i) % which.size()], Pose2::at({0.5 * s + 0.05 * i, 0.0}, 0.02 * i), kA + off,
              kB + off, true);
    }
  }
  map.activate(kNone);
  map.refresh_all();
}

TEST(WallMap, EstimateIsTheSameSummedUpAtOnceOrAsItCame) {
  WallMap map{Options{}};
  const Index w = map.add_wall(0, 1);
  fill(map, {w});
  const WallEstimate at_once = map.walls[w].estimate;
  map.activate(1);
  map.update(w);
  EXPECT_NEAR(map.walls[w].estimate.end[kEndA], at_once.end[kEndA], 1e-6);
  EXPECT_NEAR(at_once.basis.across(kA), 0.0, 0.02);
  EXPECT_NEAR((at_once.basis.point(at_once.end[kEndB]) - kB).norm(), 0.0, 0.02);
  EXPECT_EQ(map.walls[w].count, 24u);
}

TEST(WallMap, MergedWallIsTheOneThatAllPiecesWouldHaveMade) {
  WallMap whole{Options{}}, parts{Options{}};
  const Index one = whole.add_wall(0, 1);
  fill(whole, {one});
  const Index first = parts.add_wall(0, 1), second = parts.add_wall(0, 1);
  fill(parts, {first, second});
  parts.merge(first, second);
  EXPECT_EQ(parts.resolve(second), first);
  const WallEstimate& a = whole.walls[one].estimate;
  const WallEstimate& b = parts.walls[first].estimate;
  EXPECT_EQ(parts.walls[first].count, 24u);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR((a.basis.point(a.end[k]) - b.basis.point(b.end[k])).norm(), 0.0, 1e-5);
    EXPECT_NEAR(a.variance[k], b.variance[k], 1e-9);
  }
  EXPECT_NEAR(a.p_tt, b.p_tt, 1e-6 * a.p_tt);
}

TEST(WallMap, CornerCountsFromItsFifthSightingOn) {
  WallMap map{Options{}};
  map.activate(map.add_submap(Pose2{}, false, 0));
  const Index w = map.add_wall(0, 1);
  for (int i = 0; i < 5; ++i) {
    EXPECT_FALSE(map.walls[w].estimate.known[kEndA]);
    observe(map, w, Pose2{}, kA, kB, true);
  }
  EXPECT_TRUE(map.walls[w].estimate.known[kEndA]);
  map.revoke_corner(w, kEndA);
  EXPECT_FALSE(map.walls[w].estimate.known[kEndA]);
  EXPECT_TRUE(map.walls[w].estimate.known[kEndB]);
}

TEST(WallMap, ShiftMovesWhatCameAfterTheGap) {
  WallMap map{Options{}};
  const Index old = map.add_wall(0, 1), young = map.add_wall(1, 1);
  map.activate(map.add_submap(Pose2{}, false, 0));
  for (int i = 0; i < 5; ++i) observe(map, old, Pose2{}, kA, kB, true);
  map.activate(map.add_submap(Pose2{}, false, 1));
  for (int i = 0; i < 5; ++i) observe(map, young, Pose2{}, {1, 4}, {3, 4}, true);
  map.shift(1, {0.5, 0.0});
  map.refresh_all();
  const WallEstimate& moved = map.walls[young].estimate;
  EXPECT_NEAR((moved.basis.point(moved.end[kEndA]) - Vec2(1.5, 4)).norm(), 0.0, 1e-9);
  const WallEstimate& kept = map.walls[old].estimate;
  EXPECT_NEAR((kept.basis.point(kept.end[kEndA]) - kA).norm(), 0.0, 1e-9);
  int found = 0;
  map.visit_near({3.6, 4.0}, [&](Index w) { found += w == young ? 1 : 0; });
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace hallway::slam_plane::test
