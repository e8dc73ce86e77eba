// SPDX-License-Identifier: MIT
#include "slam_point/core/solver/map_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "rings.hpp"

namespace hallway::slam_point {
namespace {

using rings::noisy_ring;
using rings::total_cost;

constexpr double kPlenty = 1e12;

std::vector<Pose> stepped(const SubmapGraph& graph, double slice) {
  std::vector<Pose> poses = graph.poses;
  MapStep step;
  step.begin(graph, poses, kNone);
  while (!step.advance(slice)) {
  }
  step.apply(graph, poses);
  return poses;
}

void expect_same_bits(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t s = 0; s < a.size(); ++s) {
    EXPECT_EQ(a[s].t, b[s].t) << "submap " << s;
    EXPECT_EQ(a[s].q.coeffs(), b[s].q.coeffs()) << "submap " << s;
  }
}

TEST(MapStep, SlicesOfAnySizeGiveTheSameBits) {
  const SubmapGraph graph = noisy_ring(40, false, 1);
  const std::vector<Pose> at_once = stepped(graph, kPlenty);
  EXPECT_LT(total_cost(graph, at_once), total_cost(graph, graph.poses));
  expect_same_bits(at_once, stepped(graph, 1e5));
  expect_same_bits(at_once, stepped(graph, 1.0));
}

TEST(MapStep, ASliceIsAFractionOfTheWork) {
  const SubmapGraph graph = noisy_ring(60, false, 2);
  MapStep step;
  step.begin(graph, graph.poses, kNone);
  ASSERT_TRUE(step.advance(kPlenty));
  const double work = step.work();
  step.begin(graph, graph.poses, kNone);
  int slices = 1;
  while (!step.advance(work / 50.0)) ++slices;
  EXPECT_GE(slices, 25) << "a slice overdraws by what it began last, and no more";
  EXPECT_LE(slices, 51);
  EXPECT_EQ(step.work(), work);
}

TEST(MapStep, WhatTheGraphLearnsMeanwhileDoesNotDisturbIt) {
  SubmapGraph graph = noisy_ring(12, false, 3);
  std::vector<Pose> expected = graph.poses;
  MapStep at_once;
  at_once.begin(graph, expected, kNone);
  ASSERT_TRUE(at_once.advance(kPlenty));
  at_once.apply(graph, expected);

  MapStep step;
  step.begin(graph, graph.poses, 11);
  ASSERT_FALSE(step.advance(1.0));
  // Two more submaps, one of them at the place of the newest, new landmarks, and two that turn out to be one.
  const Pose beside{graph.poses[11].q, graph.poses[11].t + Vec3(0.5, 0.0, 0.0)};
  graph.add_submap(beside);
  graph.add_submap(graph.poses[11]);
  graph.join(12, graph.add_landmark(beside * Vec3(1.0, 2.0, 0.0), 1), Vec3(1.0, 2.0, 0.0), true);
  graph.submaps[12].members[0].count = 1;
  graph.merge(3, 4);
  ASSERT_TRUE(step.advance(kPlenty));
  const StepCost cost = step.apply(graph, graph.poses);
  EXPECT_LT(cost.after, cost.before);
  for (std::size_t s = 0; s < expected.size(); ++s) {
    EXPECT_EQ(graph.poses[s].t, expected[s].t) << "submap " << s;
    EXPECT_EQ(graph.poses[s].q.coeffs(), expected[s].q.coeffs()) << "submap " << s;
  }
  // Those made meanwhile went along with the newest as if they were of one piece with it.
  const Vec3 lies = expected[11].inverse() * graph.poses[12].t;
  EXPECT_LT((lies - Vec3(noisy_ring(12, false, 3).poses[11].q.conjugate() * Vec3(0.5, 0.0, 0.0))).norm(),
            1e-12);
  EXPECT_LT((graph.poses[13].t - expected[11].t).norm(), 1e-12);
}

TEST(MapStep, IsNotTakenWhereItWouldMakeThingsWorse) {
  SubmapGraph graph = noisy_ring(8, false, 4);
  std::vector<Pose> settled = graph.poses;
  MapStep step;
  for (int i = 0; i < 20; ++i) {
    step.begin(graph, settled, kNone);
    ASSERT_TRUE(step.advance(kPlenty));
    step.apply(graph, settled);
  }
  // Computed for poses that are off, applied to those that are right: it moves them away from the minimum.
  step.begin(graph, graph.poses, kNone);
  ASSERT_TRUE(step.advance(kPlenty));
  std::vector<Pose> poses = settled;
  const StepCost cost = step.apply(graph, poses);
  EXPECT_EQ(cost.after, cost.before);
  expect_same_bits(poses, settled);
}

TEST(MapStep, AWindowLowersTheCostAndHoldsTheRest) {
  const SubmapGraph graph = noisy_ring(12, false, 3);
  std::vector<Pose> poses = graph.poses;
  MapStep step;
  step.begin(graph, poses, {11, 9, 10, 8}, kNone);
  ASSERT_TRUE(step.advance(kPlenty));
  const StepCost cost = step.apply(graph, poses);
  EXPECT_LT(cost.after, cost.before);
  EXPECT_LT(total_cost(graph, poses), total_cost(graph, graph.poses));
  for (std::size_t s = 0; s < 8; ++s) {
    EXPECT_EQ(poses[s].t, graph.poses[s].t);
    EXPECT_EQ(poses[s].q.coeffs(), graph.poses[s].q.coeffs());
  }
}

/// The submaps of each row of `system` as one submap, in the frame of the first of them.
SubmapGraph with_groups_as_submaps(const SubmapGraph& graph, const ReducedSystem& system) {
  SubmapGraph merged(1.0);
  merged.planar = graph.planar;
  for (const LandmarkRecord& landmark : graph.landmarks) merged.add_landmark(landmark.position, 0);
  std::vector<Index> made_for(system.rows(), kNone);
  for (Index s = 0; s < graph.submaps.size(); ++s) {
    const Index row = system.row_of(s);
    Index into = row == kNone ? kNone : made_for[row];
    if (into == kNone) into = merged.add_submap(graph.poses[s]);
    if (row != kNone) made_for[row] = into;
    const Pose T_into_s = merged.poses[into].inverse() * graph.poses[s];
    for (const Member& member : graph.submaps[s].members) {
      std::vector<Member>& members = merged.submaps[into].members;
      auto known = std::find_if(members.begin(), members.end(),
                                [&](const Member& m) { return m.landmark == member.landmark; });
      if (known == members.end()) {
        const Index place = merged.join(into, member.landmark, Vec3::Zero(), false);
        known = members.begin() + place;
      }
      known->count += member.count;
      known->mean +=
          (static_cast<double>(member.count) / known->count) * (T_into_s * member.mean - known->mean);
    }
  }
  return merged;
}

TEST(MapStep, GroupsMoveAsSubmapsMadeOfThemDo) {
  for (const bool planar : {false, true}) {
    const SubmapGraph graph = noisy_ring(25, planar, 5);
    const MapStep::Grouping grouping{3, 2, 4};
    ReducedSystem system;
    system.take(graph, rings::all_of(graph), graph.poses, grouping);
    EXPECT_EQ(system.free().size(), 24u);
    // Two, six times three, and the last four.
    EXPECT_EQ(system.rows(), 11u);
    const SubmapGraph merged = with_groups_as_submaps(graph, system);
    std::vector<Pose> poses = graph.poses;
    std::vector<Pose> expected = merged.poses;
    MapStep step;
    step.begin(graph, poses, rings::all_of(graph), kNone, grouping);
    ASSERT_TRUE(step.advance(kPlenty));
    const StepCost cost = step.apply(graph, poses);
    EXPECT_LT(cost.after, cost.before);
    EXPECT_NEAR(cost.before, total_cost(graph, graph.poses), 1e-9 * cost.before);
    EXPECT_NEAR(cost.after, total_cost(graph, poses), 1e-9 * cost.before);
    step.begin(merged, expected, kNone);
    ASSERT_TRUE(step.advance(kPlenty));
    step.apply(merged, expected);
    for (Index s = 1; s < graph.submaps.size(); ++s) {
      const Index row = system.row_of(s);
      const Pose moved = poses[s] * graph.poses[s].inverse();
      const Pose wanted = expected[row + 1] * merged.poses[row + 1].inverse();
      EXPECT_LT((moved.t - wanted.t).norm(), 1e-8) << "submap " << s;
      EXPECT_LT(rotation_log(moved.q * wanted.q.conjugate()).norm(), 1e-10) << "submap " << s;
    }
  }
}

TEST(MapStep, WhatSharesLittleIsNoGroup) {
  // Neighbours in number lie five places apart.
  const SubmapGraph ring = noisy_ring(24, false, 6);
  SubmapGraph graph(1.0);
  for (const LandmarkRecord& landmark : ring.landmarks) graph.add_landmark(landmark.position, 0);
  for (Index s = 0; s < 24; ++s) {
    const Index from = 5 * s % 24;
    const Index to = graph.add_submap(ring.poses[from]);
    for (const Member& member : ring.submaps[from].members)
      graph.join(to, member.landmark, member.mean, false);
    for (std::size_t m = 0; m < graph.submaps[to].members.size(); ++m)
      graph.submaps[to].members[m].count = ring.submaps[from].members[m].count;
  }
  ReducedSystem system;
  system.take(graph, rings::all_of(graph), graph.poses, {3, 3, 0});
  EXPECT_EQ(system.rows(), 23u);
  system.take(ring, rings::all_of(ring), ring.poses, {3, 3, 0});
  EXPECT_EQ(system.rows(), 8u);
}

TEST(MapStep, TellsWhichLandmarksItHasMoved) {
  SubmapGraph graph = noisy_ring(12, false, 3);
  MapStep step;
  step.begin(graph, graph.poses, {8, 9, 10, 11}, 11);
  ASSERT_TRUE(step.advance(kPlenty));
  // Made meanwhile, and active: it goes along with submap 11.
  const Index made = graph.add_submap(graph.poses[11]);
  const Index landmark = graph.add_landmark(graph.poses[11] * Vec3(1.0, 2.0, 0.0), 1);
  graph.submaps[made].members[graph.join(made, landmark, Vec3(1.0, 2.0, 0.0), true)].count = 1;
  graph.activate(made);
  // And what an old one has come to hold.
  const Vec3 beside(0.0, 3.0, 1.0);
  const Index late = graph.add_landmark(graph.poses[8] * beside, 1);
  graph.submaps[8].members[graph.join(8, late, beside, false)].count = 4;
  graph.submaps[made]
      .members[graph.join(made, late, graph.poses[made].inverse() * (graph.poses[8] * beside), false)]
      .count = 2;
  graph.deactivate();
  graph.activate(graph.add_submap(graph.poses[11]));
  const StepCost cost = step.apply(graph, graph.poses);
  ASSERT_LT(cost.after, cost.before);
  graph.take_moved(step.touched());
  for (Index l = 0; l < graph.landmarks.size(); ++l) {
    if (graph.landmarks[l].memberships.empty() || graph.landmarks[l].count == 0) continue;
    EXPECT_LT((graph.landmarks[l].position - graph.mean_position(l)).norm(), 1e-9) << l;
  }
  // What is observed from now on counts where the submap has come to lie.
  graph.deactivate();
  graph.activate(made);
  graph.observe(0, Vec3(1.0, 2.0, 0.0), 2);
  EXPECT_LT((graph.landmarks[landmark].position - graph.mean_position(landmark)).norm(), 1e-9);
}

TEST(MapStep, OneSubmapIsNothingToMove) {
  SubmapGraph graph(1.0);
  graph.add_submap(Pose{});
  std::vector<Pose> poses = graph.poses;
  MapStep step;
  step.begin(graph, poses, 0);
  EXPECT_TRUE(step.advance(1.0));
  const StepCost cost = step.apply(graph, poses);
  EXPECT_EQ(cost.after, cost.before);
}

}  // namespace
}  // namespace hallway::slam_point
