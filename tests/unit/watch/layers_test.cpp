// SPDX-License-Identifier: MIT
#include "watch/layers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace hallway::watch {
namespace {

/// A page of 20 m x 20 m around the origin, half a metre a cell across.
class WatchLayers : public testing::Test {
 protected:
  WatchLayers() { view_.fit(Eigen::AlignedBox2d(Vec2(-9.4, -9.4), Vec2(9.4, 9.4)), 40, 20); }

  /// Draws the layer of a name alone.
  Grid draw(std::string_view name, const Moment& moment) {
    past_.add(moment);
    Canvas canvas(40, 20, Dots::kBraille);
    for (const Layer& layer : layers()) {
      if (layer.name == name) layer.draw({scene_, past_, moment}, {canvas, view_, Dots::kBraille});
    }
    Grid grid(40, 20);
    canvas.put(grid, 0, 0);
    return grid;
  }
  /// The cell that a place is in.
  Cell cell(const Grid& grid, const Vec2& place) const {
    const Vec2 dots = view_.dots_of(place, Dots::kBraille);
    return grid.at(static_cast<int>(dots.x() / 2), static_cast<int>(dots.y() / 4));
  }

  Scene scene_;
  Past past_;
  View view_;
};

Moment robot_at(const Vec2& place, double yaw) {
  return {.iteration = 1,
          .t_ns = 1'000'000'000,
          .T_world_body = Pose{from_yaw_pitch_roll(yaw, 0, 0), Vec3(place.x(), place.y(), 0)}};
}

TEST_F(WatchLayers, BeamsAndReturnsTurnWithTheRobot) {
  Moment moment = robot_at(Vec2(1, 1), std::numbers::pi / 2);
  moment.rays = {{Vec3::Zero(), Vec3(4, 0, 0), true}, {Vec3::Zero(), Vec3(0, 4, 0), false}};
  EXPECT_EQ(cell(draw("beams", moment), Vec2(1, 3)).role, Role::kRay);
  EXPECT_EQ(cell(draw("beams", moment), Vec2(-1, 1)).role, Role::kRay)
      << "left of a robot that looks north is west";
  const Grid seen = draw("seen", moment);
  EXPECT_EQ(cell(seen, Vec2(1, 5)).role, Role::kSeen);
  EXPECT_EQ(cell(seen, Vec2(-3, 1)), Cell()) << "nothing was there";
}

TEST_F(WatchLayers, ArrowLooksWhereTheRobotLooks) {
  const std::u32string arrows = U"→↗↑↖←↙↓↘";
  for (int i = -8; i <= 8; ++i) {
    const Grid grid = draw("robot", robot_at(Vec2(2, -3), i * std::numbers::pi / 4));
    EXPECT_EQ(cell(grid, Vec2(2, -3)), (Cell{arrows[static_cast<std::size_t>((i + 8) % 8)], Role::kRobot}))
        << i;
  }
}

TEST_F(WatchLayers, BodyIsDrawnWhereItIsLargeEnough) {
  scene_.outline = {Vec2(3, 2), Vec2(-3, 2), Vec2(-3, -2), Vec2(3, -2)};
  EXPECT_EQ(cell(draw("robot", robot_at(Vec2(0, 0), 0)), Vec2(1, 2)).role, Role::kRobot);
  scene_.outline = {Vec2(0.1, 0.1), Vec2(-0.1, 0.1), Vec2(-0.1, -0.1), Vec2(0.1, -0.1)};
  const Grid grid = draw("robot", robot_at(Vec2(0, 0), 0));
  int cells = 0;
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 40; ++column) cells += grid.at(column, row) == Cell() ? 0 : 1;
  }
  EXPECT_EQ(cells, 1) << "the arrow alone";
}

TEST_F(WatchLayers, ContactsAreMarkedOldAndFresh) {
  Moment moment = robot_at(Vec2(0, 0), 0);
  moment.contacts = {{.t_ns = 0, .kind = "wall", .position_m = {5, 5, 0}},
                     {.t_ns = 900'000'000, .kind = "wall", .position_m = {-5, 5, 0}}};
  moment.pressed = {Vec3(0, 1, 0)};
  const Grid grid = draw("contacts", moment);
  EXPECT_EQ(cell(grid, Vec2(5, 5)).glyph, U'x');
  EXPECT_EQ(cell(grid, Vec2(-5, 5)).glyph, U'X');
}

TEST_F(WatchLayers, WayIsInterruptedWhereItIsNotKnown) {
  Moment a = robot_at(Vec2(-8, 0), 0), b = robot_at(Vec2(0, 0), 0), c = robot_at(Vec2(8, 0), 0);
  a.iteration = 0;
  b.T_world_body.reset();
  c.iteration = 2;
  past_.add(a);
  past_.add(b);
  const Grid grid = draw("way", c);
  EXPECT_EQ(cell(grid, Vec2(-8, 0)).role, Role::kTruth);
  EXPECT_EQ(cell(grid, Vec2(8, 0)).role, Role::kTruth);
  EXPECT_EQ(cell(grid, Vec2(4, 0)), Cell());
  EXPECT_EQ(cell(grid, Vec2(-4, 0)), Cell());
}

TEST_F(WatchLayers, CommandShowsTwoSecondsAhead) {
  Moment moment = robot_at(Vec2(0, 0), std::numbers::pi);
  moment.obeyed = log::ObeyedCommand{.linear_m_s = 3.0};
  const Grid grid = draw("command", moment);
  EXPECT_EQ(cell(grid, Vec2(-5, 0)).role, Role::kRobot);
  EXPECT_EQ(cell(grid, Vec2(-8, 0)), Cell());
}

TEST_F(WatchLayers, NothingOfARobotWithoutAPose) {
  Moment moment{.iteration = 1};
  moment.rays = {{Vec3::Zero(), Vec3(1, 0, 0), true}};
  moment.topology = std::make_shared<const log::Topology>(log::Topology{.nodes = {{.id = 1}}});
  moment.drawing = {{.points_m = {{0, 0}, {1, 0}}}};
  for (const Layer& layer : layers()) {
    const Grid grid = draw(layer.name, moment);
    for (int row = 0; row < 20; ++row) EXPECT_EQ(grid.row_text(row), "") << layer.name;
  }
}

}  // namespace
}  // namespace hallway::watch
