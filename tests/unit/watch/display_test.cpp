// SPDX-License-Identifier: MIT
#include "watch/display.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "watch/keys.hpp"

namespace hallway::watch {
namespace {

Scene hall() {
  Scene scene{.name = "hall"};
  scene.plan.emplace_back(Vec2(0, 0), Vec2(30, 0));
  scene.plan.emplace_back(Vec2(0, 10), Vec2(30, 10));
  return scene;
}

Moment at(std::uint32_t iteration, double x) {
  return {.iteration = iteration,
          .t_ns = std::int64_t{iteration} * 100'000'000,
          .T_world_body = Pose{Quat::Identity(), Vec3(x, 5, 0)}};
}

/// Where the robot is drawn.
std::optional<std::pair<int, int>> robot_in(const Grid& grid) {
  for (int row = 1; row < grid.height() - 1; ++row) {
    for (int column = 0; column < grid.width(); ++column) {
      if (grid.at(column, row) == Cell{U'→', Role::kRobot}) return std::pair(column, row);
    }
  }
  return std::nullopt;
}

Display with_two() {
  Display display(hall(), {.can_restart = true});
  display.add(at(0, 2.0));
  display.add(at(1, 28.0));
  display.player().end();
  display.player().advance(0);
  return display;
}

TEST(Display, QCloses) {
  Display display(hall(), {});
  EXPECT_TRUE(display.press(' '));
  EXPECT_TRUE(display.press('%'));
  EXPECT_FALSE(display.press('q'));
}

TEST(Display, BeforeTheFirstFrame) {
  Display display(hall(), {});
  EXPECT_EQ(display.draw(80, 24).row_text(0), "hall: no frame yet");
  for (const int key :
       {int{'.'}, int{','}, int{'['}, int{']'}, int{kKeyHome}, int{kKeyEnd}, int{'f'}, int{'z'}})
    EXPECT_TRUE(display.press(key));
  EXPECT_EQ(display.player().advance(0), Player::Need::kNewer);
}

TEST(Display, FollowKeepsTheRobotInTheMiddle) {
  Display display = with_two();
  const auto first = robot_in(display.draw(80, 24));
  ASSERT_TRUE(first);
  display.press('f');
  const auto followed = robot_in(display.draw(80, 24));
  ASSERT_TRUE(followed);
  EXPECT_LT(display.view().extent_m().x(), 30.0) << "closer than all";
  display.press('.');
  display.player().advance(0);
  const auto later = robot_in(display.draw(80, 24));
  EXPECT_EQ(later, followed) << "26 m on, and still in the middle";
  display.press('a');
  const auto all = robot_in(display.draw(80, 24));
  ASSERT_TRUE(all);
  EXPECT_GT(all->first, first->first + 30);
}

TEST(Display, ArrowsMoveAndZoomScales) {
  Display display = with_two();
  display.draw(80, 24);
  const Vec2 centre = display.view().centre();
  const double cell_m = display.view().cell_m();
  display.press(kKeyRight);
  display.press(kKeyUp);
  display.draw(80, 24);
  EXPECT_GT(display.view().centre().x(), centre.x());
  EXPECT_GT(display.view().centre().y(), centre.y());
  display.press(kKeyLeft);
  display.press(kKeyDown);
  EXPECT_TRUE(display.view().centre().isApprox(centre));
  display.press('z');
  EXPECT_LT(display.view().cell_m(), cell_m);
  display.press('Z');
  EXPECT_NEAR(display.view().cell_m(), cell_m, 1e-12);
}

TEST(Display, FitsAgainWhenThePageChanges) {
  Display display = with_two();
  display.draw(80, 24);
  const double small = display.view().cell_m();
  display.draw(200, 60);
  EXPECT_LT(display.view().cell_m(), small);
  display.press('z');
  const double zoomed = display.view().cell_m();
  display.draw(80, 24);
  EXPECT_DOUBLE_EQ(display.view().cell_m(), zoomed) << "what a person chose stays";
}

TEST(Display, WithoutAMapTheWayIsShown) {
  Display display(Scene{.name = "log"}, {});
  display.add(at(0, 1000.0));
  display.player().advance(0);
  EXPECT_TRUE(robot_in(display.draw(80, 24)));
}

TEST(Display, LayersAreToggled) {
  Display display = with_two();
  ASSERT_TRUE(robot_in(display.draw(80, 24)));
  display.press('0');
  EXPECT_FALSE(robot_in(display.draw(80, 24)));
  display.press('0');
  EXPECT_TRUE(robot_in(display.draw(80, 24)));
}

TEST(Display, PointsDoNotHideAPlan) {
  const auto count = [](Display& display, Role role) {
    const Grid grid = display.draw(80, 24);
    int cells = 0;
    for (int row = 1; row < 17; ++row) {
      for (int column = 0; column < 50; ++column) cells += grid.at(column, row).role == role ? 1 : 0;
    }
    return cells;
  };
  Scene scene = hall();
  for (int i = 0; i < 300; ++i) scene.landmarks.emplace_back(0.1 * i, 0.03 * i);
  Display with_plan(scene, {});
  with_plan.add(at(0, 2.0));
  EXPECT_EQ(count(with_plan, Role::kLandmark), 0);
  with_plan.press('4');
  EXPECT_GT(count(with_plan, Role::kLandmark), 10);
  scene.plan.clear();
  Display without(scene, {});
  without.add(at(0, 2.0));
  EXPECT_GT(count(without, Role::kLandmark), 10);
}

TEST(Display, DotsChange) {
  Display display = with_two();
  const auto has = [&](char32_t low, char32_t high) {
    const Grid grid = display.draw(80, 24);
    for (int row = 1; row < 17; ++row) {
      for (int column = 0; column < 50; ++column) {
        if (grid.at(column, row).glyph >= low && grid.at(column, row).glyph <= high) return true;
      }
    }
    return false;
  };
  EXPECT_TRUE(has(0x2801, 0x28ff));
  display.press('d');
  EXPECT_TRUE(has(0x2580, 0x259f));
  display.press('d');
  EXPECT_TRUE(has(U'#', U'#'));
}

}  // namespace
}  // namespace hallway::watch
