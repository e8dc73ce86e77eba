// SPDX-License-Identifier: MIT
#include "wall_follower/core/loop_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "wall_follower/core/circuits.hpp"

namespace hallway::wall_follower {
namespace {

/// A landmark and the way to it from the one before; before the way the wall turns.
struct Mark {
  Kind kind;
  int direction;
  double size_m;
  double way_m;
  int turn = 0;
};

const double kNan = std::nan("");
constexpr double kInfinite = INFINITY;

/// One lap: twelve landmarks, four corners, no part like another one.
const std::vector<Mark> kLap{{Kind::discontinuity, 1, 0.2, 1.3},
                             {Kind::discontinuity, -1, 0.2, 0.9},
                             {Kind::corner, 0, kNan, 1.1},
                             {Kind::discontinuity, 1, kInfinite, 1.6, 1},
                             {Kind::room, 0, kNan, 0.45},
                             {Kind::discontinuity, -1, kInfinite, 0.5},
                             {Kind::corner, 0, kNan, 0.9},
                             {Kind::discontinuity, -1, 0.3, 2.0, 1},
                             {Kind::discontinuity, 1, 0.3, 0.6},
                             {Kind::corner, 0, kNan, 0.7},
                             {Kind::discontinuity, 1, 0.15, 1.2, 1},
                             {Kind::corner, 0, kNan, 2.25}};

/// Feeds a finder with landmarks, as a follower would.
class Walk {
 public:
  explicit Walk(const Options& options = {}) : finder(options), options_(options) { finder.begin(chart); }

  LoopVerdict go(const Mark& mark) {
    quarter_ += mark.turn;
    at_ += turned(Vec2(mark.way_m, 0.0), quarter_ * kQuarter);
    way_ += mark.way_m;
    Node node;
    node.kind = mark.kind;
    node.direction = mark.direction;
    node.size_m = mark.size_m;
    node.at = at_;
    node.way_m = way_;
    node.quarter = quarter_;
    chart.add(node, 1.0);
    return finder.add(chart.nodes.back());
  }

  /// Closes the loop, and begins another wall with so many turns miscounted.
  void close(const LoopVerdict& verdict, int miscounted = 0) {
    close_loop(chart, verdict.same, options_);
    finder.begin(chart);
    quarter_ += miscounted;
  }

  Chart chart;
  LoopFinder finder;

 private:
  Options options_;
  Vec2 at_ = Vec2::Zero();
  double way_ = 0.0;
  int quarter_ = 0;
};

/// The landmarks of some laps, one of which ends where the next one begins.
std::vector<Mark> laps(int number) {
  std::vector<Mark> all;
  for (int lap = 0; lap < number; ++lap) {
    for (Mark mark : kLap) {
      if (lap > 0 && all.size() % kLap.size() == 0) mark.turn = 1;
      all.push_back(mark);
    }
  }
  return all;
}

/// The step at which a loop was closed; -1: none was.
int closed_at(const std::vector<Mark>& marks, LoopVerdict* verdict = nullptr) {
  Walk walk;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const LoopVerdict found = walk.go(marks[i]);
    if (found.loop != Loop::closed) continue;
    if (verdict != nullptr) *verdict = found;
    return static_cast<int>(i);
  }
  return -1;
}

TEST(LoopFinder, FindsTheSecondLap) {
  LoopVerdict verdict;
  const int at = closed_at(laps(2), &verdict);
  ASSERT_GE(at, 12);
  EXPECT_LT(at, 20);
  ASSERT_FALSE(verdict.same.empty());
  for (const SameLandmark& pair : verdict.same) EXPECT_EQ(pair.again - pair.first, kLap.size());
}

TEST(LoopFinder, DoesNotCloseWithinALap) {
  EXPECT_EQ(closed_at(laps(1)), -1);
}

TEST(LoopFinder, AMissedLandmarkDoesNotHinder) {
  std::vector<Mark> marks = laps(2);
  marks[14].way_m += marks[13].way_m;  // the second step is missed in the second lap
  marks.erase(marks.begin() + 13);
  LoopVerdict verdict;
  const int at = closed_at(marks, &verdict);
  ASSERT_GE(at, 12);
  EXPECT_EQ(verdict.same.back().again - verdict.same.back().first, kLap.size() - 1);
}

TEST(LoopFinder, AFalseLandmarkDoesNotHinder) {
  std::vector<Mark> marks = laps(2);
  marks[14].way_m -= 0.5;
  marks.insert(marks.begin() + 14, Mark{Kind::discontinuity, -1, 0.12, 0.5});
  LoopVerdict verdict;
  ASSERT_GE(closed_at(marks, &verdict), 12);
  EXPECT_EQ(verdict.same.back().again - verdict.same.back().first, kLap.size() + 1);
}

TEST(LoopFinder, OtherSizesAndWaysAreOtherPlaces) {
  std::vector<Mark> marks = laps(2);
  for (std::size_t i = kLap.size(); i < marks.size(); ++i) marks[i].way_m *= 1.6;
  EXPECT_EQ(closed_at(marks), -1);
  marks = laps(2);
  for (std::size_t i = kLap.size(); i < marks.size(); ++i) marks[i].direction = -marks[i].direction;
  EXPECT_EQ(closed_at(marks), -1);
}

TEST(LoopFinder, WithoutAWholeTurnThereIsNoLoop) {
  std::vector<Mark> marks;  // bays that are alike, along a straight wall
  for (int i = 0; i < 20; ++i) {
    marks.push_back({Kind::discontinuity, 1, 0.2, 1.0});
    marks.push_back({Kind::discontinuity, -1, 0.2, 1.0});
  }
  EXPECT_EQ(closed_at(marks), -1);
}

TEST(LoopFinder, IsUncertainWhereItReadsAlikeTwice) {
  // Bays 0.7 m apart before and after a turn round: the last ones read like the first ones at several offsets.
  std::vector<Mark> marks;
  for (int i = 0; i < 8; ++i) marks.push_back({Kind::discontinuity, i % 2 == 0 ? 1 : -1, 0.2, 0.35});
  for (int i = 0; i < 4; ++i)
    marks.push_back({Kind::corner, 0, kNan, i % 2 == 1 ? 2.5 : i == 0 ? 0.7 : 3.5, i == 0 ? 0 : 1});
  marks.push_back({Kind::discontinuity, 1, 0.2, 0.35, 1});
  for (int i = 1; i < 8; ++i) marks.push_back({Kind::discontinuity, i % 2 == 0 ? 1 : -1, 0.2, 0.35});
  Walk walk;
  bool was_uncertain = false;
  for (const Mark& mark : marks) {
    const LoopVerdict verdict = walk.go(mark);
    EXPECT_NE(verdict.loop, Loop::closed);
    EXPECT_TRUE(verdict.same.empty());
    was_uncertain |= verdict.loop == Loop::uncertain;
  }
  EXPECT_TRUE(was_uncertain);
  // The corners behind the bays decide.
  bool is_closed = false;
  for (int i = 0; i < 4 && !is_closed; ++i)
    is_closed = walk.go({Kind::corner, 0, kNan,
                         i % 2 == 1 ? 2.5
                         : i == 0   ? 0.7
                                    : 3.5,
                         i == 0 ? 0 : 1})
                    .loop == Loop::closed;
  EXPECT_TRUE(is_closed);
}

TEST(LoopFinder, AShiftedAlignmentIsCutWhereABetterOneBreaksOff) {
  // Four rooms that are alike, and behind them a wall without any. In the second lap bumps make the way behind the rooms longer by one room: the first three rooms fit the last three.
  constexpr std::size_t kBehindRooms = 12;
  constexpr double kRoom = 2.25;
  std::vector<Mark> marks;
  for (int lap = 0; lap < 2; ++lap) {
    for (int room = 0; room < 4; ++room) {
      marks.push_back({Kind::discontinuity, 1, kInfinite, kRoom - 1.05, lap == 1 && room == 0 ? 1 : 0});
      marks.push_back({Kind::room, 0, kNan, 0.5});
      marks.push_back({Kind::discontinuity, -1, kInfinite, 0.55});
    }
    marks.push_back({Kind::corner, 0, kNan, lap == 0 ? 3.0 : 3.0 + kRoom});
    marks.push_back({Kind::discontinuity, 1, 0.3, 4.0, 1});
    marks.push_back({Kind::corner, 0, kNan, 3.0});
    marks.push_back({Kind::discontinuity, -1, 0.25, 5.0, 1});
    marks.push_back({Kind::discontinuity, 1, 0.4, 3.0});
    marks.push_back({Kind::corner, 0, kNan, 4.0});
    marks.push_back({Kind::discontinuity, -1, 0.5, 3.5, 1});
    marks.push_back({Kind::corner, 0, kNan, 3.5});
  }
  LoopVerdict verdict;
  const std::size_t lap = marks.size() / 2;
  ASSERT_GT(closed_at(marks, &verdict), static_cast<int>(lap + kBehindRooms));
  for (const SameLandmark& pair : verdict.same) EXPECT_EQ(pair.again - pair.first, lap) << pair.first;
}

TEST(LoopFinder, ClosingKeepsOneLap) {
  const std::vector<Mark> marks = laps(2);
  Walk walk;
  for (const Mark& mark : marks) {
    const LoopVerdict verdict = walk.go(mark);
    if (verdict.loop != Loop::closed) continue;
    close_loop(walk.chart, verdict.same, {});
    ASSERT_EQ(walk.chart.circuits.size(), 1U);
    const Circuit& circuit = walk.chart.circuits.front();
    ASSERT_EQ(circuit.lap.size(), kLap.size());
    EXPECT_EQ(walk.chart.nodes.size(), kLap.size());  // what leads in is of the lap
    ASSERT_EQ(walk.chart.edges.size(), kLap.size());
    EXPECT_EQ(walk.chart.edges.back().to, circuit.lap.front());
    EXPECT_EQ(walk.chart.node(circuit.lap.front()).visits, 2U);
    double length = 0.0;
    for (const Mark& one : kLap) length += one.way_m;
    EXPECT_NEAR(circuit.length_m, length, 1e-9);
    return;
  }
  FAIL();
}

/// A walk with one lap that is closed. @param next  the mark of laps(3) that is next
std::optional<Walk> closed_walk(int miscounted, std::size_t& next) {
  Walk walk;
  const std::vector<Mark> marks = laps(2);
  for (next = 0; next < marks.size(); ++next) {
    const LoopVerdict verdict = walk.go(marks[next]);
    if (verdict.loop != Loop::closed) continue;
    walk.close(verdict, miscounted);
    ++next;
    return walk;
  }
  return std::nullopt;
}

TEST(LoopFinder, AKnownWallIsKnown) {
  for (const int miscounted : {0, 1, 2, -1}) {
    std::size_t next = 0;
    std::optional<Walk> walk = closed_walk(miscounted, next);
    ASSERT_TRUE(walk);
    const std::size_t known = walk->chart.nodes.size();
    std::optional<LoopVerdict> found;
    const std::vector<Mark> marks = laps(3);
    for (; next < marks.size() && !found; ++next) {
      const LoopVerdict verdict = walk->go(marks[next]);
      if (verdict.loop == Loop::closed) found = verdict;
    }
    ASSERT_TRUE(found) << miscounted;
    ASSERT_EQ(found->circuit, 0U) << miscounted;
    const Node& again = walk->chart.wall()[found->same.back().again];
    const Node& first = walk->chart.node(walk->chart.circuits[0].lap[found->same.back().first]);
    EXPECT_EQ(first.kind, again.kind);
    const Correction correction = join_circuit(walk->chart, 0, found->same);
    EXPECT_EQ((correction.turns + miscounted) % 4, 0) << miscounted;
    EXPECT_EQ(walk->chart.nodes.size(), known);
    for (const Edge& edge : walk->chart.edges)
      EXPECT_TRUE(walk->chart.has(edge.from) && walk->chart.has(edge.to));
  }
}

TEST(LoopFinder, WhatLeadsOntoAKnownWallIsKeptOnce) {
  std::size_t next = 0;
  std::optional<Walk> walk = closed_walk(0, next);
  ASSERT_TRUE(walk);
  Chart& chart = walk->chart;
  const std::size_t known = chart.nodes.size();
  // From steps of another wall, by a crossing, onto the known one. The second time they are seen 0.2 m beside.
  const auto come = [&](std::size_t others, double beside) {
    chart.wall_begin = chart.nodes.size();
    std::vector<SameLandmark> same;
    for (std::size_t i = 0; i < others; ++i) {
      Node step;
      step.kind = Kind::discontinuity;
      step.direction = i % 3 == 0 ? 1 : -1;
      step.at = Vec2(30.0 + 2.0 * static_cast<double>(i), beside);
      chart.add(step, 1.0);
      if (i == 0) chart.edges.push_back({chart.circuits[0].lap[2], chart.nodes.back().id, 1.0, 1.0, 0, true});
    }
    for (std::size_t i = 0; i < 3; ++i) {
      chart.add(Node(chart.node(chart.circuits[0].lap[i])), 1.0);
      same.push_back({i, others + i});
    }
    join_circuit(chart, 0, same);
    for (const Edge& edge : chart.edges) EXPECT_TRUE(chart.has(edge.from) && chart.has(edge.to));
  };
  come(3, 0.0);  // where it came onto the wall, at a slant
  EXPECT_EQ(chart.nodes.size(), known);
  EXPECT_TRUE(chart.leads.empty());
  come(8, 0.0);
  EXPECT_EQ(chart.nodes.size(), known + 8);
  ASSERT_EQ(chart.leads.size(), 1U);
  const std::vector<std::uint32_t> first = chart.leads[0];
  EXPECT_EQ(first.size(), 8U);
  come(10, 0.2);  // goes on by two steps
  EXPECT_EQ(chart.nodes.size(), known + 10);
  ASSERT_EQ(chart.leads.size(), 2U);
  EXPECT_EQ(chart.leads[1].size(), 2U);
  // Where the second crossing has led is not certain.
  EXPECT_EQ(std::ranges::count_if(chart.edges, [](const Edge& edge) { return edge.is_crossing; }), 1);
  EXPECT_TRUE(std::ranges::any_of(
      chart.edges, [&](const Edge& edge) { return edge.is_crossing && edge.to == first.front(); }));
}

TEST(LoopFinder, AnotherWallIsNotAKnownOne) {
  std::size_t next = 0;
  std::optional<Walk> walk = closed_walk(0, next);
  ASSERT_TRUE(walk);
  std::vector<Mark> marks = laps(1);
  for (Mark& mark : marks) {
    mark.direction = -mark.direction;
    mark.way_m *= 1.3;
  }
  for (const Mark& mark : marks) EXPECT_NE(walk->go(mark).loop, Loop::closed);
}

TEST(LoopFinder, FirstSightsOfLandmarksSeenThrice) {
  const std::vector<SameLandmark> same{{0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 8}};
  EXPECT_EQ(first_sight(same, 8), 0U);
  EXPECT_EQ(first_sight(same, 7), 3U);
  EXPECT_EQ(first_sight(same, 2), 2U);
}

}  // namespace
}  // namespace hallway::wall_follower
