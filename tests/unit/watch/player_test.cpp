// SPDX-License-Identifier: MIT
#include "watch/player.hpp"

#include <gtest/gtest.h>

namespace hallway::watch {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
using Need = Player::Need;

Moment moment_of(std::uint32_t iteration) {
  return {.iteration = iteration, .t_ns = iteration * kSecond / 10};
}

/// Gives a player what it needs of a log of `count` moments, ten a second, until it needs nothing.
class Feeder {
 public:
  Feeder(Player& player, std::uint32_t count) : player_(player), count_(count) {}
  void advance(std::int64_t now_ns) {
    for (int i = 0; i < 100'000; ++i) {
      const Need need = player_.advance(now_ns);
      if (need == Need::kNothing) return;
      if (need == Need::kOlder) {
        player_.restart();
        next_ = 0;
        ++restarts;
      }
      if (next_ < count_) {
        player_.add(moment_of(next_++));
      } else {
        player_.end();
      }
    }
    FAIL() << "never enough";
  }
  int restarts = 0;

 private:
  Player& player_;
  std::uint32_t count_;
  std::uint32_t next_ = 0;
};

std::uint32_t shown(const Player& player) {
  return player.shown()->iteration;
}

TEST(Player, KeepsTheRobotsTime) {
  Player player(1.0, true);
  Feeder feeder(player, 1000);
  feeder.advance(5 * kSecond);
  EXPECT_EQ(shown(player), 0u);
  feeder.advance(5 * kSecond + kSecond / 20);
  EXPECT_EQ(shown(player), 0u);
  EXPECT_EQ(*player.wait_ns(5 * kSecond + kSecond / 20), kSecond / 20);
  feeder.advance(5 * kSecond + kSecond / 10);
  EXPECT_EQ(shown(player), 1u);
}

TEST(Player, IsFasterOnRequest) {
  Player player(1.0, true);
  Feeder feeder(player, 1000);
  feeder.advance(0);
  player.change_speed(4.0);
  for (std::int64_t t = 0; t <= kSecond; t += kSecond / 40) feeder.advance(t);
  EXPECT_EQ(shown(player), 40u);
  for (int i = 0; i < 40; ++i) player.change_speed(2.0);
  EXPECT_DOUBLE_EQ(player.speed(), 4096.0);
  for (int i = 0; i < 40; ++i) player.change_speed(0.5);
  EXPECT_DOUBLE_EQ(player.speed(), 1.0 / 16.0);
}

TEST(Player, DoesNotHurryAfterAStall) {
  Player player(1.0, true);
  Feeder feeder(player, 1000);
  feeder.advance(0);
  feeder.advance(kSecond / 10);
  feeder.advance(60 * kSecond);  // the machine slept
  EXPECT_EQ(shown(player), 2u);
}

TEST(Player, PausesAndGoesOnFromThere) {
  Player player(1.0, true);
  Feeder feeder(player, 1000);
  feeder.advance(0);
  player.toggle_pause();
  feeder.advance(100 * kSecond);
  EXPECT_EQ(shown(player), 0u);
  EXPECT_FALSE(player.wait_ns(100 * kSecond));
  player.toggle_pause();
  feeder.advance(200 * kSecond);
  EXPECT_EQ(shown(player), 0u);
  feeder.advance(200 * kSecond + kSecond / 10);
  EXPECT_EQ(shown(player), 1u);
}

TEST(Player, StepsAheadAndBack) {
  Player player(1.0, true);
  Feeder feeder(player, 1000);
  feeder.advance(0);
  player.step(1);
  feeder.advance(0);
  player.step(1);
  feeder.advance(0);
  EXPECT_EQ(shown(player), 2u);
  EXPECT_TRUE(player.paused());
  player.step(-1);
  feeder.advance(0);
  EXPECT_EQ(shown(player), 1u);
  player.step(-1);
  feeder.advance(0);
  player.step(-1);  // there is none before the first
  feeder.advance(0);
  EXPECT_EQ(shown(player), 0u);
  EXPECT_EQ(feeder.restarts, 0);
}

TEST(Player, SkipsAndReadsALogAgain) {
  Player player(1.0, true);
  Feeder feeder(player, 5000);
  feeder.advance(0);
  player.toggle_pause();
  player.skip(300.0);
  feeder.advance(0);
  EXPECT_EQ(shown(player), 3000u);
  player.skip(-10.0);
  feeder.advance(0);
  EXPECT_EQ(shown(player), 2900u);
  EXPECT_EQ(feeder.restarts, 0);
  player.skip(-250.0);
  feeder.advance(0);
  EXPECT_EQ(shown(player), 400u);
  EXPECT_EQ(feeder.restarts, 1);
  player.go_to_last();
  feeder.advance(0);
  EXPECT_EQ(shown(player), 4999u);
  EXPECT_TRUE(player.at_end());
  player.go_to_first();
  feeder.advance(0);
  EXPECT_EQ(shown(player), 0u);
  EXPECT_FALSE(player.at_end());
}

TEST(Player, RunThatGoesOnKeepsTheLastMoments) {
  Player player(1.0, false);
  Feeder feeder(player, 3000);
  feeder.advance(0);
  player.skip(250.0);
  feeder.advance(0);
  EXPECT_EQ(shown(player), 2500u);
  player.toggle_pause();
  player.go_to_first();
  feeder.advance(0);
  // The moment after the shown one is there already when a run is watched: 1000 are kept up to it.
  EXPECT_GE(shown(player), 2500u - Player::kKept);
  EXPECT_LE(shown(player), 2502u - Player::kKept);
  EXPECT_EQ(feeder.restarts, 0);
}

TEST(Player, StopsAtTheEnd) {
  Player player(4096.0, true);
  Feeder feeder(player, 3);
  for (std::int64_t t = 0; t < 10; ++t) feeder.advance(t * kSecond);
  EXPECT_EQ(shown(player), 2u);
  EXPECT_TRUE(player.at_end());
  EXPECT_FALSE(player.wait_ns(10 * kSecond));
}

TEST(Player, NothingToShow) {
  Player player(1.0, true);
  Feeder feeder(player, 0);
  feeder.advance(0);
  EXPECT_EQ(player.shown(), nullptr);
}

}  // namespace
}  // namespace hallway::watch
