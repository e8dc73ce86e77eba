// SPDX-License-Identifier: MIT
// A page of 20 m x 20 m around the origin: cells of 0.5 m x 1 m, so that (x, y) is in column (x + 10) / 0.5 and row 10 - y.
#include "watch/plugin_layers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geom/arrays.hpp"

namespace hallway::watch {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kNorth = std::numbers::pi / 2;

Pose pose_at(double x, double y, double yaw) {
  return {from_yaw_pitch_roll(yaw, 0.0, 0.0), Vec3(x, y, 0.0)};
}

Moment moment_at(std::uint32_t second, const Pose& T_world_body) {
  return {.iteration = second, .t_ns = second * kSecond_ns, .T_world_body = T_world_body};
}

log::TopologyNode node_of(std::uint32_t id, std::int64_t second, double x_m, double y_m,
                          log::PlaceKind kind = log::PlaceKind::kRoom) {
  return {.id = id, .kind = kind, .t_ns = second * kSecond_ns, .x_m = x_m, .y_m = y_m};
}

class PluginLayers : public testing::Test {
 protected:
  PluginLayers() {
    constexpr double kSide = 10.0 / 1.06;  // fit() leaves a margin of 6 %
    view_.fit(Eigen::AlignedBox2d(Vec2(-kSide, -kSide), Vec2(kSide, kSide)), 40, 20);
  }

  static void put(Moment& moment, log::Topology topology) {
    moment.topology = std::make_shared<const log::Topology>(std::move(topology));
  }

  Grid draw(const Moment& moment, Dots dots = Dots::kBraille) {
    past_.add(moment);
    Canvas canvas(40, 20, dots);
    draw_layers({scene_, past_, moment}, shown_, {canvas, view_, dots});
    Grid grid(40, 20);
    canvas.put(grid, 0, 0);
    return grid;
  }

  Scene scene_;
  Past past_;
  View view_;
  ShownLayers shown_;
};

TEST_F(PluginLayers, PageIsAsTheTestsHaveIt) {
  EXPECT_NEAR(view_.cell_m(), 0.5, 1e-12);
}

TEST_F(PluginLayers, PlaceIsWhereTheRobotWasAtItsTimeNotWhereItIs) {
  past_.add(moment_at(1, pose_at(2.0, 3.0, kNorth)));
  Moment now = moment_at(2, pose_at(-5.0, -5.0, 0.0));
  // 1.5 m ahead is north, 2.25 m to the right is east: (4.25, 4.5).
  put(now, {.nodes = {node_of(7, 1, 1.5, -2.25)}});
  const Grid grid = draw(now);
  EXPECT_EQ(grid.at(28, 5), (Cell{U'△', Role::kEstimate}));
  // From where the robot is now it would be (-3.5, -7.25).
  EXPECT_EQ(grid.at(13, 17), Cell());
  EXPECT_EQ(grid.at(12, 17), Cell());
}

TEST_F(PluginLayers, PlaceStaysWhenAnOlderMomentIsShownAgain) {
  Moment first = moment_at(1, pose_at(2.0, 3.0, kNorth));
  put(first, {.nodes = {node_of(7, 1, 1.5, -2.25)}});
  past_.add(first);
  past_.add(moment_at(2, pose_at(-5.0, -5.0, 0.0)));
  EXPECT_EQ(draw(first).at(28, 5).glyph, U'△');
}

TEST_F(PluginLayers, WithoutTruthPlacesAreWhereThePluginBelievesTheRobotWas) {
  Moment then{.iteration = 1, .t_ns = kSecond_ns};
  then.pose = log::PoseAnswer{
      .valid = true, .position_m = {2.0, 3.0, 0.0}, .orientation = to_array(pose_at(0, 0, kNorth).q)};
  past_.add(then);
  Moment now{.iteration = 2, .t_ns = 2 * kSecond_ns};
  now.pose = log::PoseAnswer{.valid = true, .position_m = {-5.0, -5.0, 0.0}};
  put(now, {.nodes = {node_of(7, 1, 1.5, -2.25)}});
  EXPECT_EQ(draw(now).at(28, 5).glyph, U'△');
}

TEST_F(PluginLayers, HiddenLayersDrawNothing) {
  Moment now = moment_at(1, pose_at(2.0, 3.0, kNorth));
  put(now, {.nodes = {node_of(7, 1, 1.5, -2.25)}});
  now.drawing = {{.kind = log::DrawingKind::kText, .points_m = {{-5.5, 0.0}}, .text = "seek"}};
  const auto text_at = [](const Grid& grid) {
    std::u32string text;
    for (int column = 24; column < 28; ++column) text += grid.at(column, 12).glyph;
    return text;
  };
  EXPECT_EQ(draw(now).at(28, 5).glyph, U'△');
  EXPECT_EQ(text_at(draw(now)), U"seek") << "5.5 m behind the robot: (2, -2.5), and to the right";
  ASSERT_TRUE(shown_.toggle('t'));
  EXPECT_EQ(draw(now).at(28, 5), Cell());
  EXPECT_EQ(text_at(draw(now)), U"seek");
  ASSERT_TRUE(shown_.toggle('w'));
  EXPECT_EQ(text_at(draw(now)), U"    ");
  ASSERT_TRUE(shown_.toggle('t'));
  EXPECT_EQ(draw(now).at(28, 5).glyph, U'△');
}

TEST_F(PluginLayers, EachKindHasItsOwnCharacter) {
  for (const Dots dots : {Dots::kBraille, Dots::kBlocks, Dots::kAscii}) {
    Moment now = moment_at(1, pose_at(0.25, -8.5, 0.0));
    log::Topology topology;
    for (std::uint32_t i = 0; i < 5; ++i)  // at x = -5.75, -3.75, …, y = 4.5
      topology.nodes.push_back(node_of(i, 1, 2.0 * i - 6.0, 13.0, static_cast<log::PlaceKind>(i)));
    put(now, std::move(topology));
    past_ = {};
    const Grid grid = draw(now, dots);
    std::set<char32_t> glyphs;
    for (int i = 0; i < 5; ++i) {
      const Cell& cell = grid.at(8 + 4 * i, 5);
      EXPECT_EQ(cell.role, Role::kEstimate) << i;
      EXPECT_EQ(cell.glyph, glyph_of(static_cast<log::PlaceKind>(i), dots));
      glyphs.insert(cell.glyph);
      if (dots == Dots::kAscii) {
        EXPECT_LT(cell.glyph, 0x80u);
      }
      EXPECT_EQ(glyphs_of(utf8_of(cell.glyph)), std::u32string(1, cell.glyph)) << "one column";
    }
    EXPECT_EQ(glyphs.size(), 5u);
  }
}

TEST_F(PluginLayers, EdgesJoinPlacesAndLeaveOutWhatHasNone) {
  Moment now = moment_at(1, pose_at(0.25, -8.5, 0.0));
  log::Topology topology{.nodes = {node_of(1, 1, -8.0, 9.0), node_of(2, 1, 8.0, 9.0),
                                   node_of(3, 0, 0.0, 17.0)}};  // seen before the first pose
  topology.edges = {{.from = 1, .to = 2}, {.from = 2, .to = 3}};
  put(now, topology);
  const Grid grid = draw(now);
  for (int column = 5; column < 36; ++column)  // from x = -7.75 to 8.25, y = 0.5
    EXPECT_EQ(grid.at(column, 9).role, Role::kMapped) << column;
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 40; ++column) EXPECT_EQ(grid.at(column, row), Cell());
  }
}

TEST_F(PluginLayers, StepOfTheWallGoesAwayFromTheRobotOrToIt) {
  for (const auto& [direction, row] : {std::pair(1, 6), std::pair(-1, 4)}) {
    Moment now = moment_at(1, pose_at(-2.75, -8.5, 0.0));
    log::TopologyNode node = node_of(1, 1, 0.0, 13.0, log::PlaceKind::kDiscontinuity);  // (-2.75, 4.5)
    node.direction = direction;
    node.size_m = std::numeric_limits<double>::infinity();  // as long as it may be: 1 m
    put(now, {.nodes = {node}});
    past_ = {};
    const Grid grid = draw(now);
    EXPECT_EQ(grid.at(14, 5).glyph, U'○');
    EXPECT_EQ(grid.at(14, 10 - row).role, Role::kEstimate) << direction;
    EXPECT_EQ(grid.at(14, row), Cell()) << direction;
  }
}

TEST_F(PluginLayers, RoomIsSeenInACellWithAStep) {
  Moment now = moment_at(1, pose_at(0.25, -8.5, 0.0));
  put(now, {.nodes = {node_of(1, 1, 4.0, 9.0), node_of(2, 1, 4.05, 9.05, log::PlaceKind::kDiscontinuity)}});
  EXPECT_EQ(draw(now).at(28, 9).glyph, U'△');
}

TEST_F(PluginLayers, DrawingIsAtThePresentPose) {
  past_.add(moment_at(1, pose_at(8.0, 8.0, 0.0)));
  Moment now = moment_at(2, pose_at(-5.25, -2.5, kNorth));
  now.drawing = {{.colour = log::DrawingColour::kFollowed, .points_m = {{2.0, 0.0}, {6.0, 0.0}}},
                 {.colour = log::DrawingColour::kWarning,
                  .closed = true,
                  .points_m = {{0.0, -4.0}, {4.0, -4.0}, {4.0, -8.0}, {0.0, -8.0}}},
                 {.kind = log::DrawingKind::kCircle,
                  .colour = log::DrawingColour::kSensed,
                  .radius_m = 2.0,
                  .points_m = {{9.0, -9.0}}}};
  const Grid grid = draw(now);
  for (int row = 7; row <= 10; ++row)  // ahead is north: from (-5.25, -0.5) to (-5.25, 3.5)
    EXPECT_EQ(grid.at(9, row).role, Role::kDrawn) << row;
  // The square from (-1.25, -2.5) to (2.75, 1.5): all of its sides, and nothing within.
  for (int column = 17; column <= 25; ++column) {
    EXPECT_EQ(grid.at(column, 12).role, Role::kContact) << column;
    EXPECT_EQ(grid.at(column, 8).role, Role::kContact) << column;
  }
  for (int row = 9; row < 12; ++row) {
    EXPECT_EQ(grid.at(17, row).role, Role::kContact) << row;
    EXPECT_EQ(grid.at(25, row).role, Role::kContact) << row;
    EXPECT_EQ(grid.at(21, row), Cell()) << row;
  }
  // The circle around (3.75, 6.5).
  for (const auto& [column, row] : {std::pair(23, 3), std::pair(31, 3), std::pair(27, 1), std::pair(27, 5)})
    EXPECT_EQ(grid.at(column, row).role, Role::kSeen) << column << "," << row;
  EXPECT_EQ(grid.at(27, 3), Cell());
}

TEST_F(PluginLayers, TextIsBesideARobotThatWouldCoverIt) {
  for (const double x_m : {-1.5, -1.0, 0.0}) {  // of four cells, which are 2 m
    Moment now = moment_at(1, pose_at(0.25, 0.5, 0.0));
    now.drawing = {{.kind = log::DrawingKind::kText, .points_m = {{x_m, 0.0}}, .text = "seek"}};
    EXPECT_EQ(draw(now).row_text(9).substr(20), "→seek") << x_m;
  }
  Moment now = moment_at(1, pose_at(0.25, 0.5, 0.0));
  now.drawing = {{.kind = log::DrawingKind::kText, .points_m = {{-2.0, 0.0}}, .text = "seek"}};
  EXPECT_EQ(draw(now).row_text(9).substr(16), "seek→") << "it ends before the robot";
}

TEST_F(PluginLayers, TextInAsciiIsAscii) {
  Moment now = moment_at(1, pose_at(0.25, -8.5, 0.0));
  now.drawing = {{.kind = log::DrawingKind::kText,
                  .points_m = {{0.0, 9.0}},
                  .text = "a→\x1b"
                          "b"}};
  const Grid grid = draw(now, Dots::kAscii);
  EXPECT_EQ(grid.row_text(9).substr(20), "a?\\x1bb");
}

TEST_F(PluginLayers, FarFromThePageIsLeftOut) {
  Moment now = moment_at(1, pose_at(0.25, -8.5, 0.0));
  constexpr double kFar = 1e300;
  put(now, {.nodes = {node_of(1, 1, kFar, 9.0), node_of(2, 1, 0.0, -kFar)}, .edges = {{.from = 1, .to = 2}}});
  now.drawing = {{.points_m = {{kFar, kFar}, {-kFar, kFar}}},
                 {.kind = log::DrawingKind::kCircle, .radius_m = kFar, .points_m = {{kFar, 0.0}}},
                 {.kind = log::DrawingKind::kText, .points_m = {{kFar, kFar}}, .text = "far"}};
  ASSERT_TRUE(shown_.toggle('0'));  // the robot
  ASSERT_TRUE(shown_.toggle('5'));  // and its way
  const Grid grid = draw(now);
  for (int row = 0; row < 20; ++row) EXPECT_EQ(grid.row_text(row), "") << row;
}

TEST(TopologyText, SaysNodesAndLoop) {
  log::Topology topology{.loop = log::LoopState::kUncertain};
  EXPECT_EQ(topology_text(topology), "0 nodes, loop uncertain");
  topology = {.loop = log::LoopState::kClosed, .nodes = {node_of(1, 0, 0, 0)}};
  EXPECT_EQ(topology_text(topology), "1 node, loop closed");
}

TEST(DrawnText, JoinsTextsAndKeepsThemShort) {
  log::Drawing drawing{{.points_m = {{0, 0}, {1, 0}}},
                       {.kind = log::DrawingKind::kText, .points_m = {{0, 0}}, .text = "follow"},
                       {.kind = log::DrawingKind::kText, .points_m = {{1, 0}}, .text = "0.3 m\n"}};
  EXPECT_EQ(drawn_text(drawing), "follow, 0.3 m\\n");
  drawing.resize(1);
  EXPECT_EQ(drawn_text(drawing), "");
  for (int i = 0; i < 100; ++i)
    drawing.push_back({.kind = log::DrawingKind::kText, .points_m = {{0, 0}}, .text = std::string(200, 'x')});
  EXPECT_LE(drawn_text(drawing).size(), 70u);
}

}  // namespace
}  // namespace hallway::watch
