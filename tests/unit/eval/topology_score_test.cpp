// SPDX-License-Identifier: MIT
#include "eval/topology_score.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "eval/topology_evaluator.hpp"
#include "eval/topology_json.hpp"
#include "support/temp_folder.hpp"
#include "unit/eval/wall_maps.hpp"

namespace hallway::eval {
namespace {

using test::Boundary;
using test::Drive;

/// A map, a way and what is true of both.
struct Case {
  Case(const Boundary& boundary, const Drive& drive, const test::PlaneMotion& motion = {})
      : way(drive.way(motion)),
        truth(find_truth(test::plan_of(boundary, motion), way)),
        chart(test::chart_of(truth, way)) {}

  TopologyMetrics metrics(const log::Topology& of) const { return score_topology(of, truth, way).metrics; }

  DrivenWay way;
  TopologyTruth truth;
  log::Topology chart;  ///< all that is true
};

Case niche() {
  return {test::niche_room(), test::niche_drive()};
}
Case doorways() {
  return {test::doorway_hall(), test::doorway_drive()};
}
Case staggered() {
  return {test::staggered_corridor(), test::staggered_drive()};
}

log::TopologyNode& node_of(log::Topology& chart, std::uint32_t id) {
  return *std::ranges::find(chart.nodes, id, &log::TopologyNode::id);
}

/// A room of 6 x 4 m with two niches that look alike, across from each other, and the way once around in it. The niches' edges are abreast after 0.9,
/// 1.9, 9.3 and 10.3 m, then after 17.7 and 18.7 m again.
Case two_niches() {
  Drive drive(1.1, 0.4, 0);
  drive.forward(4.5).left().forward(3.2).left().forward(5.2).left().forward(3.2).left().forward(4);
  return {{{{0, 0},
            {2, 0},
            {2, -0.3},
            {3, -0.3},
            {3, 0},
            {6, 0},
            {6, 4},
            {4, 4},
            {4, 4.3},
            {3, 4.3},
            {3, 4},
            {0, 4}}},
          drive};
}

TEST(TopologyScore, TruthItselfIsPerfect) {
  for (const Case& of : {niche(), doorways(), staggered(), two_niches()}) {
    const TopologyScore score = score_topology(of.chart, of.truth, of.way);
    const TopologyMetrics& m = score.metrics;
    EXPECT_GT(m.demanded, 0u);
    EXPECT_EQ(m.found, m.demanded);
    EXPECT_EQ(m.found + m.accepted, of.truth.nodes.size());
    EXPECT_EQ(m.undecided + m.wrong_kind + m.missed + m.duplicates + m.false_nodes, 0u);
    EXPECT_EQ(m.openings_right, m.openings);
    ASSERT_TRUE(m.place_m.has_value());
    EXPECT_LT(m.place_m->max, 1e-9);
    EXPECT_EQ(m.edges, of.chart.edges.size());
    EXPECT_EQ(m.edges_not_driven, 0u);
    ASSERT_TRUE(m.length_m.has_value());
    EXPECT_LT(m.length_m->max, 1e-9);
    EXPECT_EQ(m.came_around, of.truth.came_around);
    EXPECT_EQ(m.loop, m.came_around ? LoopVerdict::kRightly : LoopVerdict::kOpen);
  }
}

TEST(TopologyScore, WholeRoundIsClosedRightlyAndNoSooner) {
  Case of(test::doorway_hall(), test::drive_around(test::doorway_hall()[0], 0.4));
  EXPECT_EQ(of.metrics(of.chart).loop, LoopVerdict::kRightly);
  EXPECT_EQ(of.metrics(of.chart).found, 4u);
  EXPECT_EQ(of.metrics(of.chart).edges_not_driven, 0u);
  // Closed by an edge from the room's far side to the room itself, which the robot drives 1 m apart.
  of.chart.edges.push_back({10, 10, 9.0});
  EXPECT_EQ(of.metrics(of.chart).loop, LoopVerdict::kWrongly);
}

TEST(TopologyScore, CountsOfTheThreeMapsByHand) {
  const TopologyMetrics n = niche().metrics(niche().chart), d = doorways().metrics(doorways().chart),
                        s = staggered().metrics(staggered().chart);
  EXPECT_EQ(n.demanded, 2u);
  EXPECT_EQ(n.openings, 0u);
  EXPECT_EQ(n.edges, 3u);  // across the niche, round the room, across the niche
  EXPECT_EQ(d.demanded, 3u);
  EXPECT_EQ(d.openings, 3u);
  EXPECT_EQ(d.accepted, 7u);
  EXPECT_EQ(s.demanded, 2u);
  EXPECT_EQ(s.accepted, 2u);
}

TEST(TopologyScore, MissedAndFalseNodes) {
  Case of = doorways();
  node_of(of.chart, 10).kind =
      log::PlaceKind::kDiscontinuity;  // the room is not charted, but a step nearer at its far side, twice
  node_of(of.chart, 10).direction = -1;
  node_of(of.chart, 10).x_m += 1.0;
  // Nothing is at the middle of the wall between the openings.
  log::TopologyNode middle = node_of(of.chart, 11);
  middle.id = 90;
  middle.x_m += 2.5;
  of.chart.nodes.push_back(middle);
  const TopologyScore score = score_topology(of.chart, of.truth, of.way);
  EXPECT_EQ(score.metrics.missed, 1u);
  EXPECT_EQ(score.missed, std::vector<std::size_t>{0});
  EXPECT_EQ(score.metrics.found, 2u);
  EXPECT_EQ(score.metrics.duplicates, 1u);
  EXPECT_EQ(score.metrics.false_nodes, 1u);
  EXPECT_EQ(score.nodes.back().id, 90u);
  EXPECT_EQ(score.nodes.back().verdict, NodeVerdict::kFalse);
  EXPECT_LT((*score.nodes.back().place - Vec2(5.5, 0)).norm(), 1e-9);
  EXPECT_EQ(score.metrics.openings, 3u);
  EXPECT_EQ(score.metrics.openings_found, 2u);
}

TEST(TopologyScore, WrongKindsAndSweepsOfOpenings) {
  Case of = doorways();
  node_of(of.chart, 10).kind = log::PlaceKind::kHallwayEnd;  // the room
  node_of(of.chart, 13).kind = log::PlaceKind::kSweep;       // the first hallway
  node_of(of.chart, 17).kind = log::PlaceKind::kJunction;    // the second one
  const TopologyMetrics m = of.metrics(of.chart);
  EXPECT_EQ(m.wrong_kind, 1u);
  EXPECT_EQ(m.undecided, 1u);
  EXPECT_EQ(m.found, 1u);
  EXPECT_EQ(m.openings_found, 3u);
  EXPECT_EQ(m.openings_right, 1u);
  EXPECT_EQ(m.missed, 0u);
}

TEST(TopologyScore, StepOfTheOtherDirectionIsOfTheWrongKind) {
  Case of = niche();
  node_of(of.chart, 10).direction = -1;
  const TopologyMetrics m = of.metrics(of.chart);
  EXPECT_EQ(m.wrong_kind, 1u);
  EXPECT_EQ(m.found, 1u);
}

TEST(TopologyScore, OptionalNodesMayBeMissing) {
  Case of = doorways();
  std::erase_if(of.chart.nodes,
                [&](const log::TopologyNode& node) { return !of.truth.nodes[node.id - 10].is_demanded; });
  const TopologyMetrics m = of.metrics(of.chart);
  EXPECT_EQ(m.found, 3u);
  EXPECT_EQ(m.missed + m.accepted, 0u);
  EXPECT_EQ(m.edges, 0u) << "all edges have an end that is not there";
}

TEST(TopologyScore, PlaceAnywhereInAnOpeningIsRight) {
  Case of = doorways();
  node_of(of.chart, 13).x_m += 1.1;  // 1.5 m wide
  const TopologyScore score = score_topology(of.chart, of.truth, of.way);
  EXPECT_EQ(score.metrics.found, 3u);
  EXPECT_LT(*score.nodes[3].distance_m, 1e-9);
}

TEST(TopologyScore, ShiftedChart) {
  for (const double shift_m : {0.5, 1.1}) {
    Case of = niche();
    for (log::TopologyNode& node : of.chart.nodes) node.y_m += shift_m;
    const TopologyMetrics m = of.metrics(of.chart);
    EXPECT_EQ(m.found, shift_m < 0.75 ? 2u : 0u);
    EXPECT_EQ(m.false_nodes, shift_m < 0.75 ? 0u : 2u);
    if (m.place_m) {
      EXPECT_NEAR(m.place_m->mean, shift_m, 1e-9);
    }
  }
}

TEST(TopologyScore, MirroredChartIsFalse) {
  const auto mirrored = [](Case of) {
    for (log::TopologyNode& node : of.chart.nodes) node.y_m = -node.y_m;
    return of.metrics(of.chart);
  };
  for (const Case& of : {niche(), two_niches(), staggered()}) {
    const TopologyMetrics m = mirrored(of);
    EXPECT_EQ(m.found + m.wrong_kind, 0u);
    EXPECT_EQ(m.missed, m.demanded);
    EXPECT_EQ(m.edges, 0u);
  }
  EXPECT_EQ(mirrored(niche()).false_nodes, 2u);
  // Across from the second hallway's begin is the first one's: one of the three is found all the same.
  EXPECT_EQ(mirrored(doorways()).found, 1u);
}

TEST(TopologyScore, NodesOfUnknownTimesAreFalse) {
  Case of = niche();
  node_of(of.chart, 11).t_ns = std::int64_t{1} << 60;
  const TopologyScore score = score_topology(of.chart, of.truth, of.way);
  EXPECT_EQ(score.metrics.false_nodes, 1u);
  EXPECT_FALSE(score.nodes[1].place.has_value());
}

TEST(TopologyScore, EdgesAreComparedWithTheWayDriven) {
  Case of = niche();
  of.chart.edges = {{10, 11, 1.2}, {11, 10, 11.3}, {10, 10, 12.8}};
  const TopologyScore score = score_topology(of.chart, of.truth, of.way);
  ASSERT_EQ(score.edges.size(), 3u);
  // By ids: round to itself, across the niche, and on round the room.
  EXPECT_NEAR(*score.edges[0].true_m, 12.8, 1e-9);
  EXPECT_NEAR(*score.edges[1].true_m, 1.0, 1e-9);
  EXPECT_NEAR(*score.edges[2].true_m, 11.8, 1e-9);
  EXPECT_NEAR(score.metrics.length_m->max, 0.5, 1e-9);
  EXPECT_NEAR(score.metrics.length_m->mean, (0.2 + 0.5 + 0.0) / 3, 1e-9);
}

TEST(TopologyScore, EdgesThatWereNotDriven) {
  Case of = doorways();
  of.chart.edges = {{13, 10, 4.0}};  // back from the hallway to the room
  const TopologyMetrics m = of.metrics(of.chart);
  EXPECT_EQ(m.edges, 1u);
  EXPECT_EQ(m.edges_not_driven, 1u);
  EXPECT_FALSE(m.length_m.has_value());
}

TEST(TopologyScore, LoopClosedAtALikePlaceIsWrong) {
  Case of = two_niches();
  ASSERT_EQ(of.truth.nodes.size(), 4u);
  EXPECT_EQ(of.metrics(of.chart).loop, LoopVerdict::kRightly);
  // The second niche is mistaken for the first one: half of the loop, 7.4 m from the niche's end to its begin.
  std::erase_if(of.chart.nodes, [](const log::TopologyNode& node) { return node.id > 11; });
  of.chart.edges = {{10, 11, 1.0}, {11, 10, 7.4}};
  EXPECT_EQ(of.metrics(of.chart).loop, LoopVerdict::kWrongly);
  EXPECT_EQ(of.metrics(of.chart).missed, 2u);
  of.chart.loop = log::LoopState::kUncertain;
  EXPECT_EQ(of.metrics(of.chart).loop, LoopVerdict::kUncertain);
  of.chart.loop = log::LoopState::kOpen;
  EXPECT_EQ(of.metrics(of.chart).loop, LoopVerdict::kOpen);
}

TEST(TopologyScore, LoopThatWasNotDrivenIsClosedWrongly) {
  for (Case of : {doorways(), staggered()}) {
    of.chart.loop = log::LoopState::kClosed;
    EXPECT_EQ(of.metrics(of.chart).loop, LoopVerdict::kWrongly);
  }
  // Half of the loop of the niche room, closed to where it began.
  Drive half(0.6, 0.4, 0);
  half.forward(3.0).left().forward(3.2).left().forward(3.2);
  Case of{test::niche_room(), half};
  of.chart.edges.push_back({11, 10, 11.8});
  of.chart.loop = log::LoopState::kClosed;
  EXPECT_EQ(of.metrics(of.chart).loop, LoopVerdict::kWrongly);
}

TEST(TopologyScore, OrderDoesNotMatter) {
  for (const Case& of : {niche(), doorways(), staggered(), two_niches()}) {
    log::Topology chart = of.chart;
    for (log::TopologyNode& node : chart.nodes) node.x_m += 0.1 * (node.id % 3);
    const TopologyScore before = score_topology(chart, of.truth, of.way);
    std::ranges::reverse(chart.nodes);
    std::ranges::reverse(chart.edges);
    const TopologyScore after = score_topology(chart, of.truth, of.way);
    EXPECT_EQ(to_json(before.metrics).dump(), to_json(after.metrics).dump());
    ASSERT_EQ(before.nodes.size(), after.nodes.size());
    for (std::size_t i = 0; i < before.nodes.size(); ++i) {
      EXPECT_EQ(before.nodes[i].verdict, after.nodes[i].verdict);
      EXPECT_EQ(before.nodes[i].true_node, after.nodes[i].true_node);
    }
  }
}

TEST(TopologyScore, RigidMotionChangesNothing) {
  const Case here(test::doorway_hall(), test::doorway_drive());
  const Case there(test::doorway_hall(), test::doorway_drive(), {-2.1, {40, -7}});
  log::Topology chart = here.chart;
  for (log::TopologyNode& node : chart.nodes) node.x_m += 0.1 * (node.id % 3);
  const TopologyMetrics a = here.metrics(chart), b = there.metrics(chart);
  EXPECT_EQ(a.found, b.found);
  EXPECT_EQ(a.accepted, b.accepted);
  EXPECT_EQ(a.loop, b.loop);
  EXPECT_NEAR(a.place_m->rmse, b.place_m->rmse, 1e-9);
  EXPECT_NEAR(a.length_m->rmse, b.length_m->rmse, 1e-9);
}

TEST(TopologyScore, EmptyChartMissesAll) {
  const Case of = doorways();
  const TopologyMetrics m = of.metrics({});
  EXPECT_EQ(m.missed, 3u);
  EXPECT_EQ(m.charted, 0u);
  EXPECT_FALSE(m.place_m.has_value());
  EXPECT_EQ(to_json(m)["nodes"]["place_m"], nullptr);
  EXPECT_EQ(to_json(m)["loop"], "open");
}

TEST(TopologyEvaluator, ScoresTheLastTopologyOfARun) {
  const test::TempFolder folder;
  const Case of = niche();
  TopologyEvaluator evaluator(test::plan_of(test::niche_room()), folder.path());
  EXPECT_FALSE(evaluator.score().has_value());
  for (const WayPose& pose : of.way.poses()) {
    evaluator.add_pose(pose.t_ns, pose.pose.level());
    evaluator.set_topology({});
  }
  evaluator.set_topology(of.chart);
  const auto score = evaluator.score();
  ASSERT_TRUE(score.has_value());
  EXPECT_EQ(score->metrics.found, 2u);
  EXPECT_LT(score->metrics.length_m->max, 1e-9);
  EXPECT_EQ(score->metrics.loop, LoopVerdict::kRightly);
  EXPECT_EQ(to_json(score->metrics)["loop"], "rightly closed");
}

}  // namespace
}  // namespace hallway::eval
