// SPDX-License-Identifier: MIT
#include "wall_follower/core/follower.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "unit/wall_follower/plans.hpp"

namespace hallway::wall_follower {
namespace {

constexpr double kSamePlace = 0.5;  // [m]

/// It stands after the first loop.
Options first_loop() {
  Options options;
  options.exploration = 0;
  return options;
}

Drive driven(const Scene& scene, double seconds = 600.0) {
  Drive drive(scene.plan, scene.start, {}, 1, first_loop());
  drive.run(seconds);
  return drive;
}

std::size_t count(const Chart& chart, Kind kind) {
  return static_cast<std::size_t>(std::count_if(chart.nodes.begin(), chart.nodes.end(),
                                                [kind](const Node& node) { return node.kind == kind; }));
}

/// Whether a discontinuity with that size is charted near a place.
bool has_step(const Drive& drive, int direction, double size_m, const Vec2& place) {
  for (const Node& node : drive.follower.chart().nodes) {
    const bool is_size = std::isinf(size_m) ? std::isinf(node.size_m) : std::abs(node.size_m - size_m) < 0.06;
    if (node.kind == Kind::discontinuity && node.direction == direction && is_size &&
        (drive.place_of(node) - place).norm() < 0.25)
      return true;
  }
  return false;
}

void expect_closed(const Drive& drive) {
  EXPECT_EQ(drive.follower.chart().loop, Loop::closed);
  EXPECT_LT(drive.closing_error(), kSamePlace);
  EXPECT_EQ(drive.follower.state(), State::done);
}

/// Each lap is a ring: from each of its landmarks one edge leads along the wall to the next one, and the last one leads back.
void expect_rings(const Chart& chart) {
  ASSERT_FALSE(chart.circuits.empty());
  for (const Circuit& circuit : chart.circuits) {
    int turns = 0;
    double length = 0.0;
    for (std::size_t i = 0; i < circuit.lap.size(); ++i) {
      const std::uint32_t next = circuit.lap[(i + 1) % circuit.lap.size()];
      const auto edge = std::find_if(chart.edges.begin(), chart.edges.end(), [&](const Edge& one) {
        return one.from == circuit.lap[i] && !one.is_crossing;
      });
      ASSERT_NE(edge, chart.edges.end());
      EXPECT_EQ(edge->to, next);
      EXPECT_GT(edge->confidence, 0.0);
      turns += edge->quarter_turns;
      length += edge->length_m;
    }
    EXPECT_EQ(std::abs(turns), 4);
    EXPECT_NEAR(length, circuit.length_m, 0.1);
  }
}

/// Walls that are closed, and that what is charted of them is where it was seen.
void expect_explored(const Drive& drive, std::size_t circuits) {
  const Chart& chart = drive.follower.chart();
  EXPECT_EQ(drive.follower.state(), State::done);
  EXPECT_EQ(chart.circuits.size(), circuits);
  EXPECT_EQ(drive.follower.explorer().left(), 0U);
  expect_rings(chart);
  for (const Edge& edge : chart.edges) {
    const Node &from = chart.node(edge.from), &to = chart.node(edge.to);
    EXPECT_GT(edge.length_m + 1.2, (drive.place_of(from) - drive.place_of(to)).norm());
  }
}

TEST(Follower, StandsWithoutReadings) {
  Follower follower(PlanWorld::body(), {});
  for (int i = 0; i < 50; ++i) {
    Senses senses;
    senses.t_ns = i * 100'000'000LL;
    const Command command = follower.step(senses);
    EXPECT_EQ(command.forward_m_s, 0.0);
    EXPECT_EQ(command.left_rad_s, 0.0);
  }
}

TEST(Follower, KeepsItsDistanceFromAWall) {
  Drive drive(Plan().line({{-1, 0}, {30, 0}}), {{0.0, 0.7}, 0.1});
  drive.run(10.0);
  drive.run(60.0, [&] {
    EXPECT_NEAR(drive.world.truth().at.y(), Options().distance_m, 0.03);
    EXPECT_NEAR(drive.world.truth().heading, 0.0, 0.05);
  });
  EXPECT_GT(drive.world.truth().at.x(), 15.0);
  EXPECT_TRUE(drive.follower.chart().nodes.empty());
}

TEST(Follower, GoesRoundARoom) {
  const Drive drive = driven(room());
  expect_closed(drive);
  EXPECT_EQ(drive.follower.bumps(), 0);
  EXPECT_EQ(drive.follower.sweeps(), 0);
  EXPECT_EQ(count(drive.follower.chart(), Kind::corner), 4U);
  EXPECT_EQ(drive.follower.chart().nodes.size(), 4U);
  expect_rings(drive.follower.chart());
  for (const Node& node : drive.follower.chart().nodes) EXPECT_EQ(node.quarter, static_cast<int>(node.id));
}

TEST(Follower, GoesRoundABlock) {
  const Drive drive = driven(block());
  expect_closed(drive);
  const Chart& chart = drive.follower.chart();
  expect_rings(chart);
  EXPECT_EQ(count(chart, Kind::junction), 4U);
  EXPECT_TRUE(has_step(drive, 1, INFINITY, {8, 8}));
  EXPECT_TRUE(has_step(drive, 1, INFINITY, {8, 11}));
  EXPECT_TRUE(has_step(drive, 1, INFINITY, {12, 11}));
  EXPECT_TRUE(has_step(drive, 1, INFINITY, {12, 8}));
}

TEST(Follower, TurnsRightInHallways) {
  const Drive drive = driven(ring());
  expect_closed(drive);
  EXPECT_EQ(count(drive.follower.chart(), Kind::junction), 4U);
  EXPECT_EQ(count(drive.follower.chart(), Kind::corner), 0U);
  double lap = 0.0;
  for (const Edge& edge : drive.follower.chart().edges) lap += edge.length_m;
  EXPECT_NEAR(lap, 2.0 * (8.0 + 6.0) + 8.0 * 0.47, 1.5);  // straight sides, and the corners at its distance
}

TEST(Follower, PassesRooms) {
  const Drive drive = driven(doors());
  expect_closed(drive);
  const Chart& chart = drive.follower.chart();
  expect_rings(chart);
  EXPECT_EQ(count(chart, Kind::room), 3U);
  EXPECT_EQ(count(chart, Kind::junction), 0U);
  EXPECT_EQ(count(chart, Kind::corner), 4U);
  for (const double edge : {2.0, 6.0}) EXPECT_TRUE(has_step(drive, 1, INFINITY, {edge, 0})) << edge;
  for (const double edge : {2.9, 6.9}) EXPECT_TRUE(has_step(drive, -1, INFINITY, {edge, 0})) << edge;
}

TEST(Follower, ChartsStepsOfStaggeredWalls) {
  const Drive drive = driven(staggered());
  expect_closed(drive);
  EXPECT_TRUE(has_step(drive, -1, 0.3, {2, 0.3}));
  EXPECT_TRUE(has_step(drive, 1, 0.3, {3.5, 0}));
  EXPECT_TRUE(has_step(drive, 1, 0.3, {5, -0.3}));
  EXPECT_TRUE(has_step(drive, -1, 0.3, {6, 0}));
  EXPECT_TRUE(has_step(drive, -1, 0.2, {7, 0.2}));
  EXPECT_TRUE(has_step(drive, 1, 0.2, {8.5, 0}));
}

TEST(Follower, StopsInADoorwayRightBehindAStep) {
  // At a slant the detector sees the wall where the robot has been already.
  Plan plan;
  plan.line({{-1, 0},
             {3, 0},
             {3, -0.3},
             {3.35, -0.3},
             {3.35, -0.4},
             {2, -0.4},
             {2, -2.4},
             {6, -2.4},
             {6, -0.4},
             {4.2, -0.4},
             {4.2, -0.3},
             {12, -0.3}});
  Drive drive(plan, {{0.0, 0.5}, 0.0});
  drive.run(40.0);
  const Chart& chart = drive.follower.chart();
  ASSERT_EQ(count(chart, Kind::room), 1U);
  for (const Node& node : chart.nodes) {
    EXPECT_FALSE(node.is_hidden);
    if (node.kind != Kind::room) continue;
    EXPECT_GT(drive.place_of(node).x(), 3.4);
    EXPECT_LT(drive.place_of(node).x(), 4.15);
  }
  EXPECT_TRUE(has_step(drive, 1, INFINITY, {3.35, -0.3}));
  EXPECT_TRUE(has_step(drive, -1, INFINITY, {4.2, -0.3}));
}

TEST(Follower, ComesOutOfDeadEnds) {
  const Drive drive = driven(dead_ends());
  expect_closed(drive);
  EXPECT_EQ(drive.follower.bumps(), 0);
  EXPECT_EQ(count(drive.follower.chart(), Kind::corner), 5U);
}

TEST(Follower, GoesRoundAWallThatEnds) {
  const Drive drive = driven(ending_wall());
  expect_closed(drive);
  EXPECT_TRUE(has_step(drive, 1, INFINITY, {5, 4}));
}

TEST(Follower, GoesOnBehindWhatItTouches) {
  const Drive drive = driven(cabinets());
  EXPECT_GT(drive.follower.bumps(), 0);
  expect_closed(drive);
}

TEST(Follower, DoesNotCloseAtTheHalfOfASymmetricRoom) {
  const Scene scene = symmetric();
  Drive drive(scene.plan, scene.start);
  double way = 0.0;
  Vec2 last = scene.start.at;
  drive.run(600.0, [&] {
    way += (drive.world.truth().at - last).norm();
    last = drive.world.truth().at;
    if (way < 20.0) {
      EXPECT_NE(drive.follower.chart().loop, Loop::closed);
    }
  });
  expect_closed(drive);
}

TEST(Follower, DoesNotCloseWhereThereIsNoLoop) {
  Plan plan;  // a saw of steps and bays, longer than the time
  std::vector<Vec2> points{{-1, 0}};
  for (int i = 0; i < 40; ++i) {
    points.push_back({2.0 * i, 0});
    points.push_back({2.0 * i, -0.2});
    points.push_back({2.0 * i + 1.0, -0.2});
    points.push_back({2.0 * i + 1.0, 0});
  }
  plan.line(points);
  Drive drive(plan, {{-0.5, 0.5}, 0.0});
  drive.run(150.0, [&] { EXPECT_EQ(drive.follower.chart().loop, Loop::open); });
  EXPECT_GT(drive.follower.chart().nodes.size(), 30U);
}

TEST(Follower, IsTheSameEachTime) {
  const Scene scene = doors();
  Drive one(scene.plan, scene.start, stated_faults(), 7), other(scene.plan, scene.start, stated_faults(), 7);
  one.run(200.0);
  other.run(200.0);
  EXPECT_EQ(one.world.truth().at, other.world.truth().at);
  ASSERT_EQ(one.follower.chart().nodes.size(), other.follower.chart().nodes.size());
  for (std::size_t i = 0; i < one.follower.chart().nodes.size(); ++i) {
    EXPECT_EQ(one.follower.chart().nodes[i].body, other.follower.chart().nodes[i].body);
    EXPECT_EQ(one.follower.chart().nodes[i].t_ns, other.follower.chart().nodes[i].t_ns);
  }
}

TEST(Follower, CrossesFromABlockToTheWallRoundIt) {
  const Scene scene = block();
  Drive drive(scene.plan, scene.start);
  drive.run(1200.0);
  expect_explored(drive, 2);
  EXPECT_EQ(count(drive.follower.chart(), Kind::junction), 4U);
  EXPECT_EQ(count(drive.follower.chart(), Kind::corner), 4U);  // of the room
  EXPECT_EQ(std::count_if(drive.follower.chart().edges.begin(), drive.follower.chart().edges.end(),
                          [](const Edge& edge) { return edge.is_crossing; }),
            1);
}

TEST(Follower, ExploresBothSidesOfAHallway) {
  const Scene scene = ring();
  Drive drive(scene.plan, scene.start);
  drive.run(1200.0);
  expect_explored(drive, 2);
}

TEST(Follower, ExploresByCostToo) {
  Options options;
  options.exploration = 2;
  const Scene scene = ring();
  Drive drive(scene.plan, scene.start, {}, 1, options);
  drive.run(1200.0);
  expect_explored(drive, 2);
}

TEST(Follower, DoesNotEnterRoomsOnItsWayAcross) {
  // The robot begins at the block, and a doorway of the outer wall is opposite to the end of the block's wall.
  const Scene scene = doors();
  Drive drive(scene.plan, {{3.0, 1.1}, std::numbers::pi});
  drive.run(1800.0, [&] {
    const Vec2 at = drive.world.truth().at;
    EXPECT_GT(at.y(), -0.3);
    EXPECT_LT(at.x(), 11.5);
  });
  expect_explored(drive, 2);
  EXPECT_EQ(count(drive.follower.chart(), Kind::room), 3U);
}

TEST(Follower, LeavesARoomIntoWhichTheWallLeads) {
  const Scene scene = trap();
  Drive drive(scene.plan, scene.start);
  bool was_in_room = false;
  drive.run(2400.0, [&] { was_in_room |= drive.world.truth().at.y() < -1.2; });
  EXPECT_TRUE(was_in_room);
  expect_explored(drive, 2);
  // The wall round the hallway leads through the room, once.
  const Circuit& around = drive.follower.chart().circuits.front();
  EXPECT_GT(around.length_m, 38.0);
  EXPECT_LT(around.length_m, 50.0);
}

TEST(Follower, LeavesARoomWhoseLandmarksAreNeverKnownAgain) {
  const Scene scene = trap();
  Options options;
  options.match_score = 100.0;
  Drive drive(scene.plan, scene.start, {}, 1, options);
  // Across the hallway's far end and in the room by turns.
  int ways_round = 0;
  bool was_in_room = false;
  drive.run(1200.0, [&] {
    const double y = drive.world.truth().at.y();
    was_in_room |= y < -1.2;
    if (was_in_room && y > 6.5) {
      ++ways_round;
      was_in_room = false;
    }
  });
  EXPECT_GE(ways_round, 3);
  EXPECT_EQ(drive.follower.chart().loop, Loop::open);
}

TEST(Follower, ExploresWithFaults) {
  int whole = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Scene scene = ring();
    Drive drive(scene.plan, scene.start, stated_faults(), seed);
    drive.run(3000.0);
    if (drive.follower.chart().circuits.size() == 2 && drive.follower.state() == State::done) ++whole;
    for (const Circuit& circuit : drive.follower.chart().circuits) {
      // One lap of the block or of the wall round it.
      const bool is_block = std::abs(circuit.length_m - (28.0 + 8.0 * 0.47)) < 3.0;
      const bool is_around = std::abs(circuit.length_m - (40.8 - 8.0 * 0.47)) < 3.0;
      EXPECT_TRUE(is_block || is_around) << circuit.length_m;
    }
  }
  EXPECT_GE(whole, 4);
}

TEST(Follower, StopsWhenTheChartIsFull) {
  Options options;
  options.most_nodes = 8;
  const Scene scene = doors();
  Drive drive(scene.plan, scene.start, {}, 1, options);
  drive.run(300.0);
  EXPECT_EQ(drive.follower.state(), State::done);
  EXPECT_EQ(drive.follower.chart().nodes.size(), 8U);
  EXPECT_EQ(drive.follower.chart().loop, Loop::open);
  EXPECT_EQ(drive.follower.chart().note, "the chart is full");
}

}  // namespace
}  // namespace hallway::wall_follower
