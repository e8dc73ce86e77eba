// SPDX-License-Identifier: MIT
// The odometer, the median of readings, the wall's line and the rule for sweeps, each by itself.
#include <gtest/gtest.h>

#include <cmath>

#include "unit/wall_follower/plans.hpp"
#include "wall_follower/core/median_filter.hpp"
#include "wall_follower/core/odometer.hpp"
#include "wall_follower/core/sweep_rule.hpp"
#include "wall_follower/core/wall.hpp"
#include "wall_follower/topology_rows.hpp"

namespace hallway::wall_follower {
namespace {

TEST(Odometer, GoesStraightAndTurns) {
  Odometer odometer(0.24, 0.25);
  odometer.update(1.0, 1.0);
  odometer.update(3.0, 3.0);
  EXPECT_NEAR(odometer.reckoned().at.x(), 2.0, 1e-12);
  EXPECT_NEAR(odometer.way_m(), 2.0, 1e-12);
  const double rim = 0.5 * 0.24 * kQuarter / 0.75;  // of the tracks, for a turn of 90 degrees of the body
  odometer.update(3.0 - rim, 3.0 + rim);
  EXPECT_NEAR(odometer.reckoned().heading, kQuarter, 1e-12);
  EXPECT_NEAR(odometer.way_m(), 2.0, 1e-12);
}

TEST(Odometer, TakesTurnsAsMultiplesOf90Degrees) {
  Odometer odometer(0.24, 0.25);
  odometer.update(0.0, 0.0);
  odometer.align_first(0.0);
  const double rim =
      0.5 * 0.24 * kQuarter /
      0.65;  // it slips more than expected: the body turns by 90 degrees, and is taken to turn by more
  odometer.update(-rim, rim);
  EXPECT_GT(odometer.charted().heading, kQuarter + 0.1);
  odometer.align_after_turn(0.0);
  EXPECT_NEAR(odometer.charted().heading, kQuarter, 1e-12);
  EXPECT_EQ(odometer.quarter(0.0), 1);
  EXPECT_GT(odometer.turn_slip(), 0.27);
  EXPECT_LT(odometer.turn_slip(), 0.36);
}

TEST(Odometer, DoesNotAlignOnSlantedWalls) {
  Odometer odometer(0.24, 0.25);
  odometer.update(0.0, 0.0);
  odometer.align_first(0.0);
  odometer.align_on_way(0.5);
  EXPECT_EQ(odometer.charted().heading, 0.0);
  odometer.align_on_way(0.1);
  EXPECT_GT(odometer.charted().heading, 0.0);
  EXPECT_LT(odometer.charted().heading, 0.1);
}

TEST(MedianFilter, DropsTwoFalseReadingsOfFive) {
  MedianFilter filter;
  EXPECT_TRUE(std::isinf(filter.range_m()));
  for (const double range : std::initializer_list<double>{0.4, INFINITY, 0.41, 0.1, 0.42})
    filter.add(range, {});
  EXPECT_EQ(filter.range_m(), 0.41);
  filter.clear();
  EXPECT_FALSE(filter.ready());
}

/// Goes along the x axis and sees a wall at its right at the distances that a function of x gives. @return the discontinuities
template <typename Distance>
std::vector<Step> walk(Wall& wall, double length_m, Distance distance) {
  std::vector<Step> steps;
  for (double x = 0.0; x < length_m; x += 0.015) {
    WallPoint point;
    point.at = {x, -distance(x)};
    point.way_m = x;
    if (const auto step = wall.add(point)) steps.push_back(*step);
  }
  return steps;
}

TEST(Wall, FindsItsLine) {
  Wall wall{Options()};
  wall.expect({0.0, -0.5}, 0.0);
  EXPECT_FALSE(wall.is_measured());
  EXPECT_TRUE(walk(wall, 3.0, [](double x) { return 0.5 + 0.05 * x; }).empty());
  EXPECT_TRUE(wall.is_measured());
  EXPECT_NEAR(wall.direction(), -0.05, 0.01);
  EXPECT_NEAR(wall.distance({3.0, 0.0}), 0.65, 0.01);
  EXPECT_NEAR(wall.slant({{3.0, 0.0}, 0.1}), 0.15, 0.01);
}

TEST(Wall, FindsSteps) {
  Wall wall{Options()};
  wall.expect({0.0, -0.5}, 0.0);
  const auto steps = walk(wall, 4.0, [](double x) { return x < 1.0 ? 0.5 : x < 2.5 ? 0.7 : 0.4; });
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].direction, 1);
  EXPECT_NEAR(steps[0].size_m, 0.2, 0.01);
  EXPECT_NEAR(steps[0].at.way_m, 1.0, 0.03);
  EXPECT_EQ(steps[1].direction, -1);
  EXPECT_NEAR(steps[1].size_m, 0.3, 0.01);
  EXPECT_NEAR(steps[1].at.way_m, 2.5, 0.03);
}

TEST(Wall, TakesNoStepForASlit) {
  Wall wall{Options()};
  wall.expect({0.0, -0.5}, 0.0);
  EXPECT_TRUE(walk(wall, 3.0, [](double x) { return x > 1.0 && x < 1.06 ? 0.7 : 0.5; }).empty());
}

/// A sweep of 24 pings; those within 20 degrees to the right have these ranges.
Sweep sweep_of(double ahead, double right, double behind) {
  Sweep sweep;
  for (int i = 0; i < 24; ++i) sweep.pings.push_back({radians(15.0 * i), 1.0});
  sweep.pings[17].range_m = behind;
  sweep.pings[18].range_m = right;
  sweep.pings[19].range_m = ahead;
  return sweep;
}

Opening opening_of(const Sweep& sweep) {
  return classify(view_of(sweep, -kQuarter, Options()), 0.47, Options());
}

TEST(SweepRule, TellsRoomsFromHallways) {
  EXPECT_EQ(opening_of(sweep_of(2.5, 2.6, 2.5)), Opening::room);
  EXPECT_EQ(opening_of(sweep_of(6.0, 7.0, INFINITY)), Opening::hallway);
  EXPECT_EQ(opening_of(sweep_of(INFINITY, INFINITY, INFINITY)), Opening::hallway);
  EXPECT_EQ(opening_of(sweep_of(0.46, 0.47, 0.5)), Opening::covered);
}

TEST(SweepRule, OnePingMayBeLostOrFalse) {
  EXPECT_EQ(opening_of(sweep_of(2.5, INFINITY, 2.5)), Opening::room);
  EXPECT_EQ(opening_of(sweep_of(1.0, 7.0, 7.1)), Opening::hallway);
}

TEST(SweepRule, LooksIntoTheOpeningAlsoAtASlant) {
  const Sweep sweep = sweep_of(7.0, 7.0, 7.0);
  const OpeningView view = view_of(sweep, -kQuarter + radians(10.0), Options());
  EXPECT_EQ(view.pings, 3);
  EXPECT_EQ(view.heard, 3);
  EXPECT_EQ(view_of({}, 0.0, Options()).pings, 0);
}

/// A chart of these kinds, 1 m apart, with a turn to the left behind each corner.
Chart chart_of(const std::vector<Kind>& kinds) {
  Chart chart;
  int quarter = 0;
  for (const Kind kind : kinds) {
    Node node;
    node.kind = kind;
    node.way_m = static_cast<double>(chart.nodes.size());
    node.quarter = quarter;
    if (kind == Kind::corner) ++quarter;
    chart.add(node, kind == Kind::corner ? 0.5 : 1.0);
  }
  return chart;
}

TEST(TopologyRows, LeadOverCorners) {
  const Chart chart =
      chart_of({Kind::corner, Kind::room, Kind::corner, Kind::corner, Kind::discontinuity, Kind::corner});
  const TopologyRows rows = topology_rows(chart);
  ASSERT_EQ(rows.nodes.size(), 2U);
  EXPECT_EQ(rows.nodes[0].id, 1U);
  EXPECT_EQ(rows.nodes[1].id, 4U);
  ASSERT_EQ(rows.edges.size(), 1U);
  EXPECT_EQ(rows.edges[0].from, 1U);
  EXPECT_EQ(rows.edges[0].to, 4U);
  EXPECT_EQ(rows.edges[0].length_m, 3.0);
  EXPECT_EQ(rows.edges[0].quarter_turns, 2);
  EXPECT_EQ(rows.edges[0].confidence, 0.5);
}

TEST(TopologyRows, LeadRoundALoop) {
  Chart chart = chart_of({Kind::room, Kind::corner, Kind::junction, Kind::corner});
  chart.edges.push_back({3, 0, 1.0, 1.0, 2});
  const TopologyRows rows = topology_rows(chart);
  ASSERT_EQ(rows.edges.size(), 2U);
  EXPECT_EQ(rows.edges[1].from, 2U);
  EXPECT_EQ(rows.edges[1].to, 0U);
  EXPECT_EQ(rows.edges[1].length_m, 2.0);
  EXPECT_EQ(rows.edges[0].quarter_turns + rows.edges[1].quarter_turns, 3);
}

TEST(TopologyRows, ALoopOfCornersHasNoNodes) {
  Chart chart = chart_of({Kind::corner, Kind::corner});
  chart.edges.push_back({1, 0, 1.0, 1.0, 1});
  EXPECT_TRUE(topology_rows(chart).nodes.empty());
  EXPECT_TRUE(topology_rows(chart).edges.empty());
}

TEST(Options, AreWithinTheirRanges) {
  EXPECT_NO_THROW(check_options(Options(), parameters()));
  for (const auto& row : parameters()) EXPECT_NE(row.help, nullptr);
}

}  // namespace
}  // namespace hallway::wall_follower
