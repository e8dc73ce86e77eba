// SPDX-License-Identifier: MIT
#include "slam_point/core/places/map_parts.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

/// Adds a submap at `T_part_submap` that knows `points` (part frame), each as a landmark of its own.
Index add_submap(SubmapGraph& graph, const Pose& T_part_submap, const std::vector<Vec3>& points) {
  const Index submap = graph.add_submap(T_part_submap);
  for (const Vec3& p : points) {
    const Index landmark = graph.add_landmark(p, 0);
    const Index member = graph.join(submap, landmark, T_part_submap.inverse() * p, true);
    graph.submaps[submap].members[member].count = 3;
    graph.resum(landmark);
  }
  return submap;
}

const Pose kT_a_b{rotation_exp(Vec3(0.1, -0.2, 2.0)), Vec3(40.0, -7.0, 3.0)};

/// Part 0: two submaps, six landmarks. Part 1: one submap, landmarks 6, 7 and 8, of which 6 and 7 are landmarks 4 and 5 again.
struct Two {
  SubmapGraph graph{1.0};
  MapParts parts{graph, 0.3};
  std::vector<Vec3> truth{{1, 0, 0}, {5, 2, 1}, {9, -3, 2}, {30, 0, 0}, {35, 3, 1}, {33, -6, 2}, {50, 1, 1}};

  Two() {
    parts.begin();
    parts.anchor(add_submap(graph, Pose{}, {truth[0], truth[1], truth[2]}));
    add_submap(graph, scenes::heading(Vec3(30, 0, 0), 0.3), {truth[3], truth[4], truth[5]});
    parts.begin();
    const Pose T_b_a = kT_a_b.inverse();
    parts.anchor(add_submap(graph, Pose{}, {T_b_a * truth[4], T_b_a * truth[5], T_b_a * truth[6]}));
  }
  void finish() {
    while (parts.is_joining()) parts.advance(1);
  }
  void expect_joined(const Pose& T_a_told) {
    EXPECT_EQ(parts.count(), 1u);
    EXPECT_EQ(parts.first(), graph.part());
    EXPECT_EQ(graph.landmarks[6].merged_into, 4u);
    EXPECT_EQ(graph.landmarks[7].merged_into, 5u);
    EXPECT_EQ(graph.landmarks[8].merged_into, kNone);
    EXPECT_EQ(graph.landmarks[4].count, 6u);
    const Pose told = T_a_told * graph.poses[parts.anchor_of(graph.part())].inverse();
    for (const Index l : {0u, 1u, 2u, 3u, 4u, 5u, 8u}) {
      EXPECT_EQ(graph.landmarks[l].part, graph.part());
      EXPECT_LT((told * graph.landmarks[l].position - truth[l == 8 ? 6 : l]).norm(), 1e-9) << l;
    }
    EXPECT_TRUE(graph.submaps[0].held);
    EXPECT_FALSE(graph.submaps[2].held);
  }
};

TEST(MapParts, LandmarksOfOtherPartsAreFoundNowhere) {
  Two two;
  std::vector<Index> seen;
  const auto look = [&](const Vec3& p) {
    seen.clear();
    two.graph.visit_landmarks_near(p, [&](Index l) { seen.push_back(l); });
  };
  look(two.truth[0]);
  EXPECT_TRUE(seen.empty());
  two.graph.set_part(0);
  look(two.truth[0]);
  EXPECT_EQ(seen, std::vector<Index>{0});
}

TEST(MapParts, TheSmallerOneMovesIntoTheLarger) {
  Two two;
  const Pose T = two.parts.join(0, 1, kT_a_b);
  EXPECT_LT((T.t - kT_a_b.t).norm(), 1e-12);
  EXPECT_TRUE(two.parts.is_joining());
  two.finish();
  two.expect_joined(Pose{});
  EXPECT_EQ(two.parts.take_merges().size(), 2u);
}

TEST(MapParts, WhicheverIsSaidFirst) {
  Two two;
  const Pose T = two.parts.join(1, 0, kT_a_b.inverse());
  EXPECT_LT(T.t.norm(), 1e-12);  // what is now one lies in the frame of the larger one
  two.finish();
  two.expect_joined(Pose{});
}

TEST(MapParts, TheFrameStaysThatOfTheOldestSubmapWhenItsPartMoves) {
  Two two;
  for (int more = 0; more < 4; ++more) add_submap(two.graph, Pose{}, {});  // part 1 is the larger one now
  two.parts.join(0, 1, kT_a_b);
  EXPECT_EQ(two.graph.part(), 1u);
  two.finish();
  EXPECT_EQ(two.parts.anchor_of(1), 0u);
  EXPECT_GT(two.graph.poses[0].t.norm(), 1.0);
  two.expect_joined(Pose{});
}

TEST(MapParts, WhatWasSeenTogetherStaysTwo) {
  Two two;
  two.graph.set_part(1);
  // Landmark 9 lies on 8, and the submap of part 1 sees both.
  const Index near = two.graph.add_landmark(two.graph.landmarks[8].position + Vec3(0.05, 0, 0), 0);
  const Index member = two.graph.join(2, near, two.graph.landmarks[near].position, true);
  two.graph.submaps[2].members[member].count = 3;
  two.graph.resum(near);
  two.parts.join(0, 1, kT_a_b);
  two.finish();
  EXPECT_EQ(two.graph.landmarks[near].merged_into, kNone);
  EXPECT_EQ(two.graph.landmarks[8].merged_into, kNone);
}

TEST(MapParts, APartGivenUpLeavesNothing) {
  Two two;
  two.graph.set_part(0);
  two.parts.drop(1);
  EXPECT_EQ(two.parts.count(), 1u);
  EXPECT_EQ(two.graph.dropped_landmarks(), 3u);
  for (const Index l : {6u, 7u, 8u}) EXPECT_EQ(two.graph.landmarks[l].part, kNone);
  EXPECT_TRUE(two.graph.submaps[2].members.empty());
}

TEST(PartMeeting, BelievesTheSecondOfTwoThatSayTheSame) {
  const std::vector<Vec3> points{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}};
  PartMeeting meeting(0.5);
  const Pose other{rotation_exp(Vec3(0, 0, 0.1)), Vec3::Zero()};
  EXPECT_FALSE(meeting.confirm(1, 0, Pose{}, points));
  EXPECT_FALSE(meeting.confirm(1, 0, other, points));  // a metre off at 10 m
  EXPECT_FALSE(meeting.confirm(1, 2, other, points));
  EXPECT_TRUE(meeting.confirm(1, 2, {other.q, Vec3(0.3, 0, 0)}, points));
}

}  // namespace
}  // namespace hallway::slam_point
