// SPDX-License-Identifier: MIT
#include "robot/schedule.hpp"

#include <gtest/gtest.h>

namespace hallway::robot {
namespace {

using std::chrono::milliseconds;

class ScheduleTest : public testing::Test {
 protected:
  Clock::time_point at(int ms) const { return begin_ + milliseconds(ms); }
  Clock::time_point begin_{milliseconds(123'456)};
  Schedule schedule_{begin_, milliseconds(10)};
};

TEST_F(ScheduleTest, PointsFollowEachOther) {
  EXPECT_EQ(schedule_.next(at(0)), at(0));
  EXPECT_EQ(schedule_.next(at(0)), at(10));
  EXPECT_EQ(schedule_.next(at(12)), at(20));
}

TEST_F(ScheduleTest, ALateStepDoesNotMoveThoseAfterIt) {
  schedule_.next(at(0));
  EXPECT_EQ(schedule_.next(at(37)), at(40)) << "those that are past are passed over";
  EXPECT_EQ(schedule_.next(at(41)), at(50));
}

TEST_F(ScheduleTest, APointThatIsNowIsNotPast) {
  schedule_.next(at(0));
  EXPECT_EQ(schedule_.next(at(30)), at(30));
}

TEST_F(ScheduleTest, ManyStepsDoNotDrift) {
  Schedule thirds(begin_, std::chrono::nanoseconds(3'333'333));
  Clock::time_point last{};
  for (int i = 0; i < 1'000'000; ++i) last = thirds.next(begin_);
  EXPECT_EQ(last, begin_ + 999'999 * std::chrono::nanoseconds(3'333'333));
}

TEST(SleepUntil, DoesNotEndBeforeItsTime) {
  const auto then = Clock::now() + milliseconds(5);
  sleep_until(then);
  EXPECT_GE(Clock::now(), then);
  sleep_until(then - milliseconds(100));
}

}  // namespace
}  // namespace hallway::robot
