// SPDX-License-Identifier: MIT
#include "slam_plane/core/frame_matcher.hpp"

#include <gtest/gtest.h>

#include "unit/slam_plane/observations.hpp"

namespace hallway::slam_plane::test {
namespace {

/// A map with walls as given, each seen five times from the origin.
struct SmallMap {
  Options options;
  WallMap map{options};
  std::vector<Index> all;

  SmallMap() { map.activate(map.add_submap(Pose2{}, false, 0)); }
  Index add(const Vec2& a, const Vec2& b, bool corners = false, std::uint32_t epoch = 0) {
    const Index w = map.add_wall(epoch, 1);
    map.join(map.active(), w, true);
    const AssociatedObservation s = seen(Pose2{}, a, b, corners, corners);
    for (int i = 0; i < 5; ++i) map.observe(map.walls[w].active_member, Pose2{}, s, s.corner);
    map.update(w);
    all.push_back(w);
    return w;
  }
  Index recent_match(const AssociatedObservation& s) {
    std::vector<AssociatedObservation> frame{s};
    FrameMatcher(options).match_recent(map, all, 100, Pose2{}, frame);
    return frame[0].wall;
  }
  Index map_match(const AssociatedObservation& s, std::uint32_t since = 0) {
    std::vector<AssociatedObservation> frame{s};
    FrameMatcher matcher(options);
    matcher.match_recent(map, {}, 100, Pose2{}, frame);
    matcher.match_map(map, since, Pose2{}, frame);
    return frame[0].wall;
  }
};

TEST(FrameMatcher, TakesThePieceThatOverlaps) {
  SmallMap m;
  const Index w = m.add({5, 2}, {5, -2});
  EXPECT_EQ(m.recent_match(observation({5.05, 1}, {5.05, -3})), w);
  EXPECT_EQ(m.map_match(observation({5.05, 1}, {5.05, -3})), w);
}

TEST(FrameMatcher, NeighboursOnOneLineAreTwoWalls) {
  SmallMap m;
  m.add({5, 2}, {5, -2});
  EXPECT_EQ(m.recent_match(observation({5, -2.2}, {5, -4})), kNone);
  EXPECT_EQ(m.recent_match(observation({5, -1.8}, {5, -4})), kNone);
}

TEST(FrameMatcher, FarOffTurnedAndBackFacingWallsAreOthers) {
  SmallMap m;
  m.add({5, 2}, {5, -2});
  EXPECT_EQ(m.recent_match(observation({5.3, 2}, {5.3, -2})), kNone);
  EXPECT_EQ(m.recent_match(observation({5.3, 2}, {4.7, -2})), kNone);
  EXPECT_EQ(m.recent_match(observation({5, -2}, {5, 2})), kNone);
}

TEST(FrameMatcher, OfTwoPiecesAtOnePlaceTheBetterOneIsTheWall) {
  SmallMap m;
  const Index w = m.add({5, 2}, {5, -2});
  std::vector<AssociatedObservation> frame{observation({5.1, 2}, {5.1, -2}),
                                           observation({5.01, 2}, {5.01, -2})};
  FrameMatcher(m.options).match_recent(m.map, m.all, 100, Pose2{}, frame);
  EXPECT_EQ(frame[0].wall, kNone);
  EXPECT_EQ(frame[1].wall, w);
}

TEST(FrameMatcher, TwoPartsOfOneWallAreBothTheWall) {
  SmallMap m;
  const Index w = m.add({5, 2}, {5, -2});
  std::vector<AssociatedObservation> frame{observation({5, 2}, {5, 0.5}), observation({5, -0.5}, {5, -2})};
  FrameMatcher(m.options).match_recent(m.map, m.all, 100, Pose2{}, frame);
  EXPECT_EQ(frame[0].wall, w);
  EXPECT_EQ(frame[1].wall, w);
}

TEST(FrameMatcher, CornersThatContradictRefuseAWallSeenLongAgo) {
  SmallMap m;
  m.add({5, 2}, {5, -2}, true);
  EXPECT_EQ(m.map_match(observation({5, 2}, {5, -2.7})), kNone);  // goes on beyond the corner
}

TEST(FrameMatcher, WallsBeyondAGapAreNotTakenByPlace) {
  SmallMap m;
  m.add({5, 2}, {5, -2}, false, 0);
  const Index young = m.add({5.15, 2}, {5.15, -2}, false, 1);
  EXPECT_EQ(m.map_match(observation({5.05, 2}, {5.05, -2}), 1), young);
}

TEST(FrameMatcher, HeadingIsCorrectedByTheMedianAngle) {
  SmallMap m;
  m.add({5, 2}, {5, -2});
  m.add({1, 3}, {6, 3});
  m.add({6, -3}, {1, -3});
  std::vector<AssociatedObservation> frame;
  const Pose2 truth = Pose2::at({0, 0}, 0.12);
  frame.push_back(seen(truth, {5, 2}, {5, -2}));
  frame.push_back(seen(truth, {1, 3}, {6, 3}));
  frame.push_back(seen(truth, {6, -3.1}, {1, -2.9}));  // turned by itself
  Pose2 T;
  FrameMatcher(m.options).correct_heading(m.map, m.all, frame, T);
  EXPECT_NEAR(T.heading(), 0.12, 1e-9);
}

}  // namespace
}  // namespace hallway::slam_plane::test
