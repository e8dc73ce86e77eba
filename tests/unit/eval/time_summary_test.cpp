// SPDX-License-Identifier: MIT
#include "eval/time_summary.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace hallway::eval {
namespace {

TEST(Summarize, NothingIsNothing) {
  EXPECT_FALSE(summarize({}));
}

TEST(Summarize, OneValueIsEverything) {
  const auto summary = summarize({2.5});
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->mean, 2.5);
  EXPECT_EQ(summary->p50, 2.5);
  EXPECT_EQ(summary->p99, 2.5);
  EXPECT_EQ(summary->max, 2.5);
}

TEST(Summarize, PercentilesAreValuesByNearestRank) {
  const auto summary = summarize({4, 1, 3, 2});
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->mean, 2.5);
  EXPECT_EQ(summary->p50, 2.0);
  EXPECT_EQ(summary->p99, 4.0);
  EXPECT_EQ(summary->max, 4.0);
}

TEST(Summarize, AHundredValuesLeaveTheHighestOut) {
  std::vector<double> values(100);
  std::iota(values.rbegin(), values.rend(), 1.0);
  const auto summary = summarize(values);
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->p50, 50.0);
  EXPECT_EQ(summary->p99, 99.0);
  EXPECT_EQ(summary->max, 100.0);
}

TEST(Summarize, TheRankIsRoundedUp) {
  std::vector<double> values(101);
  std::iota(values.begin(), values.end(), 1.0);
  const auto summary = summarize(values);
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->p50, 51.0);
  EXPECT_EQ(summary->p99, 100.0);
}

TEST(Summarize, AFractionOfARankBelowAHalfIsRoundedUpToo) {
  std::vector<double> values(60);
  std::iota(values.begin(), values.end(), 1.0);
  EXPECT_EQ(summarize(values)->p99, 60.0);  // rank 59.4
}

}  // namespace
}  // namespace hallway::eval
