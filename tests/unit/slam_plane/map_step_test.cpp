// SPDX-License-Identifier: MIT
#include "slam_plane/core/map_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <Eigen/Cholesky>

#include "base/random.hpp"
#include "unit/slam_plane/observations.hpp"

namespace hallway::slam_plane::test {
namespace {

/// A chain of submaps round a room, each displaced by what a drift makes, that share walls and corners.
WallMap displaced_map(std::uint64_t seed, int n_submaps) {
  const Random random(seed, stream_id("map_step_test"));
  const Vec2 corners[] = {{-6, -4}, {0, -4}, {6, -4}, {6, 4}, {1, 4}, {-6, 4}};
  constexpr std::uint32_t kWalls = 6;
  WallMap map{Options{}};
  for (std::uint32_t w = 0; w < kWalls; ++w) map.add_wall(0, 1);
  for (std::uint32_t s = 0; s < static_cast<std::uint32_t>(n_submaps); ++s) {
    const Pose2 truth =
        Pose2::at({random.uniform(s, 0, -2, 2), random.uniform(s, 1, -2, 2)}, random.uniform(s, 2, -3, 3));
    const Pose2 drift = s == 0 ? Pose2{}
                               : Pose2::at({0.05 * random.normal(s, 3), 0.05 * random.normal(s, 4)},
                                           0.01 * random.normal(s, 5));
    map.activate(map.add_submap(drift * truth, false, 0));
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t w = (s + i) % kWalls;
      map.join(map.active(), w, true);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const Vec2 off(0.01 * random.normal(s, 100 * i + k), 0.01 * random.normal(s, 100 * i + k + 50));
        const AssociatedObservation seen_now =
            seen(truth, corners[(w + 1) % kWalls] + off, corners[w] + off, i % 2 == 0, true);
        map.observe(map.walls[w].active_member, Pose2{}, seen_now, seen_now.corner);
      }
    }
  }
  map.activate(kNone);
  map.refresh_all();
  return map;
}

std::vector<Pose2> stepped(WallMap map, double work) {
  MapStep step;
  step.set_tolerance(1e-12);
  step.begin(map);
  while (!step.advance(map, work)) {
  }
  EXPECT_TRUE(step.apply(map));
  std::vector<Pose2> poses;
  for (const SubmapRecord& submap : map.submaps) poses.push_back(submap.T_map_submap);
  return poses;
}

/// The cost of a map: of all submaps' evidence against the best walls for these poses.
double cost(const WallMap& map) {
  double sum = 0.0;
  for (const WallRecord& wall : map.walls) {
    WallForm all;
    double own = 0.0;
    const WallBasis& basis = wall.estimate.basis;
    for (const Membership& at : wall.memberships) {
      const SubmapRecord& submap = map.submaps[at.submap];
      const Pose2 T = submap.T_map_submap.inverse();
      const WallForm form =
          submap.members[at.member].evidence.form({T * basis.origin, T.rotate(basis.direction)}, map.noise());
      const double d = form.h(0, 0) * form.h(1, 1) - form.h(0, 1) * form.h(0, 1);
      own += (form.h(1, 1) * form.b[0] * form.b[0] - 2 * form.h(0, 1) * form.b[0] * form.b[1] +
              form.h(0, 0) * form.b[1] * form.b[1]) /
             d;
      if (form.e(0, 0) > 0.0) own += form.f[0] * form.f[0] / form.e(0, 0);
      if (form.e(1, 1) > 0.0) own += form.f[1] * form.f[1] / form.e(1, 1);
      all.add(form);
    }
    const double d = all.h(0, 0) * all.h(1, 1) - all.h(0, 1) * all.h(0, 1);
    sum += own - (all.h(1, 1) * all.b[0] * all.b[0] - 2 * all.h(0, 1) * all.b[0] * all.b[1] +
                  all.h(0, 0) * all.b[1] * all.b[1]) /
                     d;
    if (all.e(0, 0) > 0.0) sum -= all.f[0] * all.f[0] / all.e(0, 0);
    if (all.e(1, 1) > 0.0) sum -= all.f[1] * all.f[1] / all.e(1, 1);
  }
  return sum;
}

TEST(MapStep, SlicesOfAnySizeGiveTheSameBits) {
  const WallMap map = displaced_map(1, 12);
  const std::vector<Pose2> whole = stepped(map, 1e12);
  for (const double work : {1.0, 37.0, 500.0}) {
    const std::vector<Pose2> sliced = stepped(map, work);
    for (std::size_t s = 0; s < whole.size(); ++s) {
      EXPECT_EQ(sliced[s].t, whole[s].t);
      EXPECT_EQ(sliced[s].r, whole[s].r);
    }
  }
}

TEST(MapStep, StepsLeadToTheLeastCost) {
  WallMap map = displaced_map(2, 12);
  const double before = cost(map);
  MapStep step;
  step.set_tolerance(1e-12);
  for (int i = 0; i < 4; ++i) {
    step.begin(map);
    step.advance(map, 1e12);
    ASSERT_TRUE(step.apply(map));
    map.refresh_all();
  }
  EXPECT_LT(step.largest_move(), 1e-5);
  const double least = cost(map);
  EXPECT_LT(least, 0.1 * before);
  // Nowhere near is it smaller.
  const Random random(2, stream_id("near"));
  for (std::uint32_t i = 0; i < 60; ++i) {
    WallMap other = map;
    const auto s = 1 + static_cast<std::size_t>(random.uniform(i, 0) * 11.0);
    other.submaps[s].T_map_submap = other.submaps[s].T_map_submap.moved(
        1e-3 * Vec2(random.normal(i, 1), random.normal(i, 2)), 1e-3 * random.normal(i, 3));
    other.refresh_all();
    EXPECT_GT(cost(other), least - 1e-6 * before);
  }
}

TEST(MapStep, FirstSubmapStays) {
  const WallMap map = displaced_map(3, 8);
  EXPECT_EQ(stepped(map, 1e12)[0].t, map.submaps[0].T_map_submap.t);
}

TEST(MapStep, WhatNothingDeterminesIsNotMoved) {
  // Two submaps that share two parallel walls and no corner.
  WallMap map{Options{}};
  const Index w[2] = {map.add_wall(0, 1), map.add_wall(0, 1)};
  for (int s = 0; s < 2; ++s) {
    map.activate(map.add_submap(Pose2::at({0.3 * s, 0.1 * s}, 0.0), false, 0));
    for (int k = 0; k < 2; ++k) {
      map.join(map.active(), w[k], true);
      const AssociatedObservation seen_now =
          k == 0 ? seen(Pose2{}, {1, 2}, {9, 2}) : seen(Pose2{}, {9, -2}, {1, -2});
      map.observe(map.walls[w[k]].active_member, Pose2{}, seen_now, seen_now.corner);
    }
  }
  map.activate(kNone);
  map.refresh_all();
  MapStep step;
  for (int i = 0; i < 3; ++i) {
    step.begin(map);
    step.advance(map, 1e12);
    ASSERT_TRUE(step.apply(map));
    map.refresh_all();
  }
  EXPECT_NEAR(map.submaps[1].T_map_submap.t.x(), 0.3, 1e-3);
  EXPECT_NEAR(map.submaps[1].T_map_submap.t.y(), 0.0, 1e-4);
}

TEST(MapStep, NewSubmapsMoveWithTheActiveOne) {
  WallMap map = displaced_map(4, 8);
  map.activate(5);
  MapStep step;
  step.begin(map);
  const Pose2 last = map.submaps[5].T_map_submap;
  const Pose2 relative = Pose2::at({1, 2}, 0.3);
  map.add_submap(last * relative, false, 0);
  step.advance(map, 1e12);
  ASSERT_TRUE(step.apply(map));
  const Pose2 now = map.submaps[5].T_map_submap.inverse() * map.submaps[8].T_map_submap;
  EXPECT_NEAR((now.t - relative.t).norm(), 0.0, 1e-9);
}

TEST(MapStep, StepOfAPartLeavesTheRest) {
  WallMap map = displaced_map(5, 12);
  map.activate(9);
  const std::vector<SubmapRecord> before = map.submaps;
  const SubmapNeighbourhood part = neighbourhood(map, 4);
  ASSERT_EQ(part.submaps.size(), 4u);
  EXPECT_EQ(part.submaps.front(), 9u);
  MapStep step;
  step.begin(map, part);
  step.advance(map, 1e12);
  ASSERT_TRUE(step.apply(map));
  for (Index s = 0; s < 12; ++s) {
    const bool in = std::find(part.submaps.begin(), part.submaps.end(), s) != part.submaps.end();
    const bool stays = map.submaps[s].T_map_submap.t == before[s].T_map_submap.t;
    EXPECT_EQ(stays, !in || s == 0) << s;
  }
}

TEST(MapStep, WholeMapIsAllThatThereIs) {
  WallMap map = displaced_map(6, 9);
  map.add_submap(Pose2{}, false, 0);  // which nothing hangs together with
  map.activate(3);
  const SubmapNeighbourhood all = whole_map(map);
  EXPECT_EQ(all.submaps.size(), 10u);
  EXPECT_EQ(all.submaps.front(), 3u);
  EXPECT_EQ(all.submaps.back(), 9u);
  EXPECT_EQ(all.walls.size(), 6u);
}

}  // namespace
}  // namespace hallway::slam_plane::test
