// SPDX-License-Identifier: MIT
#include "slam_plane/core/corner_judge.hpp"

#include <gtest/gtest.h>

#include "unit/slam_plane/pieces.hpp"
#include "unit/slam_plane/runs.hpp"
#include "unit/slam_plane/scenes.hpp"

namespace hallway::slam_plane::test {
namespace {

std::vector<Sighting> judged(std::vector<Sighting> frame, const View& view = {}) {
  CornerJudge(Options{}).judge(view, frame);
  return frame;
}

TEST(CornerJudge, EndInTheOpenIsACorner) {
  const auto frame = judged({sighting({5, 1}, {5, -1})});
  EXPECT_TRUE(frame[0].corner[kEndA]);
  EXPECT_TRUE(frame[0].corner[kEndB]);
}

TEST(CornerJudge, EndAtTheSideOfTheViewIsACut) {
  const auto frame = judged({sighting({5, 4.99}, {5, -1})});
  EXPECT_FALSE(frame[0].corner[kEndA]);
  EXPECT_FALSE(frame[0].hidden[kEndA]);
  EXPECT_TRUE(frame[0].corner[kEndB]);
}

TEST(CornerJudge, EndAtTheFarBoundIsACut) {
  const auto frame = judged({sighting({11.98, 1}, {6, 1.0})});
  EXPECT_FALSE(frame[0].corner[kEndA]);
  EXPECT_TRUE(frame[0].corner[kEndB]);
}

TEST(CornerJudge, BoundOfRangeCutsAtTheSides) {
  const Sighting wall = sighting({9.9, 6.8}, {9.9, 0});  // 12.01 m away, at a depth of 9.9 m
  View view;
  EXPECT_TRUE(judged({wall}, view)[0].corner[kEndA]);
  view.range_bounds_sides = true;
  EXPECT_FALSE(judged({wall}, view)[0].corner[kEndA]);
}

TEST(CornerJudge, WhatIsBehindAnEdgeIsCutAndTheEdgeIsACorner) {
  // A pillar's face hides the left part of the wall behind.
  const auto frame = judged({sighting({3, 1}, {3, 0}), sighting({6, 0}, {6, -2})});
  EXPECT_TRUE(frame[0].corner[kEndB]);
  EXPECT_FALSE(frame[1].corner[kEndA]);
  EXPECT_TRUE(frame[1].hidden[kEndA]);
  EXPECT_TRUE(frame[1].corner[kEndB]);
}

TEST(CornerJudge, WallsThatMeetInANicheHaveTheirCorner) {
  const auto frame = judged({sighting({4, 2}, {6, 2}), sighting({6, 2}, {6, -2})});
  EXPECT_TRUE(frame[0].corner[kEndB]);
  EXPECT_TRUE(frame[1].corner[kEndA]);
}

TEST(CornerJudge, FewCutsPassAndMostCornersDo) {
  Sensor sensor;
  sensor.occlusion = true;
  const Scene scene = corridor_loop(1);
  const CornerJudge judge(options_for(sensor));
  int corners = 0, found = 0, cuts = 0, taken = 0;
  for (const TrueFrame& frame : observe(scene, sensor, 1)) {
    std::vector<Sighting> sightings;
    for (const Piece& piece : frame.pieces) sightings.push_back(sighting(piece.a, piece.b));
    judge.judge(sensor.view, sightings);
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      for (int k = 0; k < 2; ++k) {
        ++(frame.corner[k][i] ? corners : cuts);
        if (sightings[i].corner[k]) ++(frame.corner[k][i] ? found : taken);
      }
    }
  }
  EXPECT_GT(found, 0.6 * corners);
  EXPECT_LT(taken, 0.001 * cuts);
}

}  // namespace
}  // namespace hallway::slam_plane::test
