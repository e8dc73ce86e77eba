// SPDX-License-Identifier: MIT
#include "wall_follower/core/explorer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hallway::wall_follower {
namespace {

/// A sweep that hears walls so far away to the left, ahead and to the right of a robot that stands along a wall [m].
Sweep heard(double left, double ahead, double right) {
  Sweep sweep;
  for (int i = 0; i < 24; ++i) {
    const double direction = radians(15.0 * i);
    const double c = std::cos(direction), s = std::sin(direction);
    const double range = c > 0.7 ? ahead : s > 0.7 ? left : s < -0.7 ? right : 2.0;
    sweep.pings.push_back({direction, range});
  }
  return sweep;
}

/// Walks along the sides of a square from a corner, to the left or to the right, with a sweep at the middle of each side.
class Square {
 public:
  explicit Square(Explorer& explorer) : explorer_(explorer) {}

  /// @param turn  +1: the wall is around the robot  @param across  what each sweep hears to the left [m]
  void walk(const Vec2& corner, double side, int turn, const std::vector<double>& across) {
    const double from = way_;
    int quarter = 0;
    Vec2 at = corner;
    for (int k = 0; k < 4; ++k) {
      const Vec2 along = unit(quarter * kQuarter), aside = unit((quarter + 1) * kQuarter);
      for (double step = 0.0; step < side; step += 0.25) {
        explorer_.see_wall(at + step * along, way_ + step);
        if (std::abs(step - side / 2) > 0.01) continue;
        explorer_.see_exits(heard(across[static_cast<std::size_t>(k)], 0.3, 0.3),
                            at + step * along + 0.5 * aside, quarter, 0.0, way_ + step, false);
        explorer_.name_exits(next_++);
      }
      at += side * along;
      way_ += side;
      quarter += turn;
    }
    explorer_.close(from, way_, Vec2::Zero(), turn > 0);
  }

 private:
  Explorer& explorer_;
  double way_ = 0.0;
  std::uint32_t next_ = 0;
};

TEST(Explorer, NextIsTheFirstExitAhead) {
  Explorer explorer{Options{}};
  Square(explorer).walk({3, 7}, 4.0, -1, {2.4, 2.4, 2.4, 2.4});
  EXPECT_EQ(explorer.left(), 4U);
  const auto route = explorer.next(0, 3.0, Exploration::right_hand);
  ASSERT_TRUE(route);
  EXPECT_NEAR(explorer.station_m(explorer.exits()[route->exit]), 6.0, 1e-9);
  EXPECT_NEAR(route->way_m, 3.0, 1e-9);
  EXPECT_FALSE(route->landing);
  EXPECT_FALSE(explorer.next(0, 3.0, Exploration::none));
}

TEST(Explorer, BehindTheLastExitTheLapBeginsAgain) {
  Explorer explorer{Options{}};
  Square(explorer).walk({3, 7}, 4.0, -1, {2.4, 2.4, 2.4, 2.4});
  const auto route = explorer.next(0, 15.0, Exploration::right_hand);
  ASSERT_TRUE(route);
  EXPECT_NEAR(route->way_m, 3.0, 1e-9);  // 1 m to the lap's end, 2 m to the first exit
}

TEST(Explorer, CostCountsWhatIsAcross) {
  Explorer explorer{Options{}};
  Square(explorer).walk({3, 7}, 4.0, -1, {9.0, 1.0, 9.0, 9.0});
  const auto next = explorer.next(0, 0.0, Exploration::right_hand),
             least = explorer.next(0, 0.0, Exploration::cost);
  ASSERT_TRUE(next && least);
  EXPECT_NEAR(explorer.station_m(explorer.exits()[next->exit]), 2.0, 1e-9);
  EXPECT_NEAR(explorer.station_m(explorer.exits()[least->exit]), 6.0, 1e-9);
}

TEST(Explorer, AnExitThatMeetsAKnownWallIsExplained) {
  Explorer explorer{Options{}};
  Square square(explorer);
  square.walk({3, 7}, 4.0, -1, {2.4, 2.4, 2.4, 2.4});
  square.walk({0, 0}, 10.0, 1, {2.4, 2.4, 2.4, 2.4});
  EXPECT_EQ(explorer.left(), 0U);
  EXPECT_FALSE(explorer.next(0, 0.0, Exploration::right_hand));
  for (const Exit& exit : explorer.exits()) {
    const auto landing = explorer.landing(exit);
    ASSERT_TRUE(landing);
    EXPECT_NE(landing->circuit, *exit.circuit);
  }
}

TEST(Explorer, AnExitThatWasTriedIsNotTriedAgain) {
  Explorer explorer{Options{}};
  Square(explorer).walk({3, 7}, 4.0, -1, {2.4, 2.4, 2.4, 2.4});
  for (std::size_t i = 0; i < explorer.exits().size(); ++i) {
    for (int k = 0; k < 3; ++k) explorer.miss_exit(i);
  }
  EXPECT_EQ(explorer.left(), 0U);
}

TEST(Explorer, TheWayToAFartherExitLeadsAcross) {
  Explorer explorer{Options{}};
  Square square(explorer);
  square.walk({3, 7}, 4.0, -1, {2.4, 2.4, 2.4, 2.4});
  square.walk({0, 0}, 10.0, 1, {2.4, 2.4, 2.4, 2.4});
  square.walk({20, 7}, 4.0, -1, {2.4, 2.4, 2.4, 2.4});  // beyond the room, and not reached from it
  EXPECT_FALSE(explorer.next(0, 0.0, Exploration::right_hand));
  const auto beyond = explorer.next(2, 0.0, Exploration::right_hand);
  ASSERT_TRUE(beyond);
  EXPECT_EQ(explorer.exits()[beyond->exit].circuit, 2U);
}

TEST(Explorer, WhatWasNotClosedIsForgotten) {
  Explorer explorer{Options{}};
  explorer.see_exits(heard(3.0, 3.0, 3.0), Vec2(0, 0), 0, 0.0, 1.0, true);
  explorer.name_exits(1);
  EXPECT_EQ(explorer.exits().size(), 3U);
  explorer.begin();
  EXPECT_TRUE(explorer.exits().empty());
}

TEST(Explorer, ExitsWithoutALandmarkAreNone) {
  Explorer explorer{Options{}};
  explorer.see_exits(heard(3.0, 3.0, 3.0), Vec2(0, 0), 0, 0.0, 1.0, true);
  explorer.name_exits(std::nullopt);
  EXPECT_TRUE(explorer.exits().empty());
}

}  // namespace
}  // namespace hallway::wall_follower
