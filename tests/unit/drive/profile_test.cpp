// SPDX-License-Identifier: MIT
#include "drive/profile.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hallway::drive {
namespace {

constexpr Rates kRates{.growing = 0.5, .shrinking = 2.0};

TEST(Profile, GrowsAndShrinksAtItsRates) {
  const Profile up(100, 0.0, 0.6, kRates);
  EXPECT_EQ(up.end_ns(), 1'200'000'100);
  EXPECT_EQ(up.at(0), 0.0);
  EXPECT_EQ(up.at(100), 0.0);
  EXPECT_NEAR(up.at(600'000'100), 0.3, 1e-15);
  EXPECT_EQ(up.at(1'200'000'100), 0.6);
  EXPECT_EQ(up.at(9'000'000'000), 0.6);
  EXPECT_EQ(Profile(0, -0.6, -0.2, kRates).end_ns(), 200'000'000);
}

TEST(Profile, GoesThroughZeroAtBothRates) {
  const Profile profile(0, 0.4, -0.25, kRates);
  EXPECT_EQ(profile.next_vertex(0), 200'000'000);
  EXPECT_EQ(profile.at(200'000'000), 0.0);
  EXPECT_EQ(profile.next_vertex(200'000'000), 700'000'000);
  EXPECT_EQ(profile.target(), -0.25);
  EXPECT_EQ(profile.next_vertex(700'000'000), std::numeric_limits<std::int64_t>::max());
}

TEST(Profile, DurationIsRoundedUp) {
  EXPECT_EQ(Profile(0, 0.0, 1.0, {.growing = 3.0, .shrinking = 3.0}).end_ns(), 333'333'334);
  EXPECT_EQ(Profile(0, 0.0, 1e-300, kRates).end_ns(), 1);
  EXPECT_EQ(Profile(7, 0.3, 0.3, kRates).end_ns(), 7);
  EXPECT_EQ(Profile(0, 0.1, 0.8, {.growing = 0.7, .shrinking = 1.0}).end_ns(),
            1'000'000'000);  // despite rounding
}

TEST(Profile, LineTakesTheLowestRateThatItNeeds) {
  EXPECT_EQ(line_duration_ns(0.4, -0.1, kRates), 1'000'000'000);
  EXPECT_EQ(line_duration_ns(0.5, 0.1, kRates), 200'000'000);
  const Profile line = Profile::line(10, 0.4, -0.4, 30);
  EXPECT_NEAR(line.at(20), 0.0, 1e-16);
  EXPECT_EQ(line.at(30), -0.4);
}

}  // namespace
}  // namespace hallway::drive
