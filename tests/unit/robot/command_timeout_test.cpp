// SPDX-License-Identifier: MIT
#include "robot/command_timeout.hpp"

#include <gtest/gtest.h>

namespace hallway::robot {
namespace {

TEST(CommandTimeout, EndsACommandOnceWhenItsTimeIsOver) {
  CommandTimeout timeout(100);
  EXPECT_FALSE(timeout.expires(1'000)) << "there is no command";
  timeout.obey(1'000);
  EXPECT_FALSE(timeout.expires(1'099));
  EXPECT_TRUE(timeout.expires(1'100));
  EXPECT_FALSE(timeout.expires(1'200)) << "it has ended";
  timeout.obey(1'300);
  EXPECT_TRUE(timeout.expires(2'000));
  EXPECT_EQ(timeout.count(), 2u);
}

TEST(CommandTimeout, ANewCommandBeginsAnew) {
  CommandTimeout timeout(100);
  timeout.obey(0);
  timeout.obey(90);
  EXPECT_FALSE(timeout.expires(189));
  EXPECT_TRUE(timeout.expires(190));
}

TEST(CommandTimeout, EndsNothingOfARobotThatWasStopped) {
  CommandTimeout timeout(100);
  timeout.obey(0);
  timeout.forget();
  EXPECT_FALSE(timeout.expires(500));
  EXPECT_EQ(timeout.count(), 0u);
}

TEST(CommandTimeout, WithoutALimitACommandHolds) {
  CommandTimeout timeout(0);
  timeout.obey(0);
  EXPECT_FALSE(timeout.expires(INT64_MAX));
}

}  // namespace
}  // namespace hallway::robot
