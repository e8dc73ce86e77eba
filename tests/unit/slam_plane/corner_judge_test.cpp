// SPDX-License-Identifier: MIT
#include "slam_plane/core/corner_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "unit/slam_plane/observations.hpp"
#include "unit/slam_plane/runs.hpp"
#include "unit/slam_plane/scenes.hpp"

namespace hallway::slam_plane::test {
namespace {

std::vector<AssociatedObservation> judged(std::vector<AssociatedObservation> frame, const View& view = {}) {
  CornerJudge(Options{}).judge(view, frame);
  return frame;
}

TEST(CornerJudge, EndInTheOpenIsACorner) {
  const auto frame = judged({observation({5, 1}, {5, -1})});
  EXPECT_TRUE(frame[0].corner[kEndA]);
  EXPECT_TRUE(frame[0].corner[kEndB]);
}

TEST(CornerJudge, EndAtTheSideOfTheViewIsACut) {
  const auto frame = judged({observation({5, 4.99}, {5, -1})});
  EXPECT_FALSE(frame[0].corner[kEndA]);
  EXPECT_FALSE(frame[0].hidden[kEndA]);
  EXPECT_TRUE(frame[0].corner[kEndB]);
}

TEST(CornerJudge, EndAtTheFarBoundIsACut) {
  const auto frame = judged({observation({11.99, 1}, {6, 1.0})});
  EXPECT_FALSE(frame[0].corner[kEndA]);
  EXPECT_TRUE(frame[0].corner[kEndB]);
}

TEST(CornerJudge, BoundOfRangeCutsAtTheSides) {
  const AssociatedObservation wall = observation({9.9, 6.8}, {9.9, 0});  // 12.01 m away, at a depth of 9.9 m
  View view;
  EXPECT_TRUE(judged({wall}, view)[0].corner[kEndA]);
  view.range_bounds_sides = true;
  EXPECT_FALSE(judged({wall}, view)[0].corner[kEndA]);
}

TEST(CornerJudge, WhatIsBehindAnEdgeIsCutAndTheEdgeIsACorner) {
  // A pillar's face hides the left part of the wall behind.
  const auto frame = judged({observation({3, 1}, {3, 0}), observation({6, 0}, {6, -2})});
  EXPECT_TRUE(frame[0].corner[kEndB]);
  EXPECT_FALSE(frame[1].corner[kEndA]);
  EXPECT_TRUE(frame[1].hidden[kEndA]);
  EXPECT_TRUE(frame[1].corner[kEndB]);
}

TEST(CornerJudge, WallsThatMeetInANicheHaveTheirCorner) {
  const auto frame = judged({observation({4, 2}, {6, 2}), observation({6, 2}, {6, -2})});
  EXPECT_TRUE(frame[0].corner[kEndB]);
  EXPECT_TRUE(frame[1].corner[kEndA]);
}

TEST(CornerJudge, AWallThatIsFacedHasItsEndNearerToTheBorderThanOneSeenFromTheSide) {
  // The place across a wall is known least: of a wall that is faced it does not move the end's bearing.
  const Vec2 end = 2.0 * Vec2(std::cos(0.72), std::sin(0.72));  // 3.7 degrees inside
  const Vec2 side = left_of(end).normalized();
  EXPECT_TRUE(judged({observation(end, end - 2.0 * side)})[0].corner[kEndA]);
  EXPECT_FALSE(judged({observation(end, 0.6 * end - 0.1 * side)})[0].corner[kEndA]);
}

/// A map of walls whose ends are all certain corners, seen well.
WallMap map_of(const std::vector<std::pair<Vec2, Vec2>>& walls) {
  WallMap map{Options{}};
  map.activate(map.add_submap(Pose2{}, false, 0));
  for (const auto& [a, b] : walls) {
    const Index w = map.add_wall(0, 1);
    map.join(map.active(), w, true);
    const AssociatedObservation s = seen(Pose2{}, a, b, true, true);
    for (int i = 0; i < 100; ++i) map.observe(map.walls[w].active_member, Pose2{}, s, s.corner);
    map.update(w);
  }
  return map;
}

/// What is made of the walls of a map, seen from its origin, in which the pose is known to 1 cm and 0.1 degrees.
std::vector<AssociatedObservation> recalled(const std::vector<std::pair<Vec2, Vec2>>& walls) {
  const WallMap map = map_of(walls);
  const CornerJudge judge{Options{}};
  std::vector<AssociatedObservation> frame;
  for (const auto& [a, b] : walls) {
    frame.push_back(observation(a, b));
    frame.back().wall = static_cast<Index>(frame.size() - 1);
  }
  judge.judge(View{}, frame);
  judge.recall(View{}, map, {Pose2{}, Vec3(1e-4, 1e-4, 3e-6).asDiagonal()}, frame);
  return frame;
}

TEST(CornerJudge, ACornerThatTheMapHasInViewIsOneThoughItsSightingMightBeACut) {
  const Vec2 right(3, -1);
  const auto end_at = [](double bearing_deg) {
    return Vec2(3, 3 * std::tan(bearing_deg * std::numbers::pi / 180.0));
  };
  EXPECT_FALSE(judged({observation(end_at(43), right)})[0].corner[kEndA]);
  EXPECT_TRUE(recalled({{end_at(43), right}})[0].corner[kEndA]);
  EXPECT_FALSE(recalled({{end_at(44.8), right}})[0].corner[kEndA]);
}

TEST(CornerJudge, ACornerThatTheMapHasBesideAnEdgeIsOneAndBehindItNone) {
  const std::pair<Vec2, Vec2> pillar{{3, 1}, {3, 0}};
  const auto far = [](double y) { return std::pair<Vec2, Vec2>{{6, y}, {9, -1}}; };
  const auto beside = recalled({pillar, far(-0.08)});
  EXPECT_TRUE(beside[1].corner[kEndA]);
  EXPECT_FALSE(beside[1].hidden[kEndA]);
  EXPECT_FALSE(
      judged({observation(pillar.first, pillar.second), observation({6, -0.08}, {9, -1})})[1].corner[kEndA]);
  const auto behind = recalled({pillar, far(0.02)});
  EXPECT_FALSE(behind[1].corner[kEndA]);
  EXPECT_TRUE(behind[1].hidden[kEndA]);
}

TEST(CornerJudge, AnEndElsewhereThanTheMapsCornerStaysACut) {
  const WallMap map = map_of({{{3, 2}, {3, -2}}});
  const CornerJudge judge{Options{}};
  std::vector<AssociatedObservation> frame{observation({3, 2.9}, {3, -2})};
  frame[0].wall = 0;
  judge.judge(View{}, frame);
  EXPECT_FALSE(judge.recall(View{}, map, {Pose2{}, Vec3(1e-4, 1e-4, 3e-6).asDiagonal()}, frame));
  EXPECT_FALSE(frame[0].corner[kEndA]);
}

TEST(CornerJudge, FewCutsPassAndMostCornersDo) {
  Sensor sensor;
  sensor.occlusion = true;
  const Scene scene = corridor_loop(1);
  const CornerJudge judge(options_for(sensor));
  int corners = 0, found = 0, cuts = 0, taken = 0;
  for (const TrueFrame& frame : observe(scene, sensor, 1)) {
    std::vector<AssociatedObservation> observations;
    for (const WallObservation& given : frame.observations)
      observations.push_back(observation(given.a, given.b));
    judge.judge(sensor.view, observations);
    for (std::size_t i = 0; i < observations.size(); ++i) {
      for (int k = 0; k < 2; ++k) {
        ++(frame.corner[k][i] ? corners : cuts);
        if (observations[i].corner[k]) ++(frame.corner[k][i] ? found : taken);
      }
    }
  }
  EXPECT_GT(found, 0.6 * corners);
  EXPECT_LT(taken, 0.001 * cuts);
}

}  // namespace
}  // namespace hallway::slam_plane::test
