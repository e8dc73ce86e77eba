// SPDX-License-Identifier: MIT
#include "robot/latency.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace hallway::robot {
namespace {

using std::chrono::nanoseconds;

TEST(Latency, OfNothingIsZero) {
  EXPECT_EQ(Latency().quantile(0.5).count(), 0);
  EXPECT_EQ(Latency().worst().count(), 0);
}

TEST(Latency, OfOneIsThatOne) {
  for (const std::int64_t ns : {0LL, 1LL, 31LL, 32LL, 1'000'003LL, 9'000'000'000'000'000'000LL}) {
    Latency latency;
    latency.add(nanoseconds(ns));
    EXPECT_EQ(latency.quantile(0.5).count(), ns) << "the class's end, but not above the worst";
  }
}

TEST(Latency, QuantilesAreThoseOfASortedListToOnePartIn32) {
  Latency latency;
  std::vector<std::int64_t> sorted;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    // From nanoseconds to seconds, evenly in powers.
    const auto ns = static_cast<std::int64_t>(1ull << (i % 31)) + static_cast<std::int64_t>(i * 7919 % 1000);
    sorted.push_back(ns);
    latency.add(nanoseconds(ns));
  }
  std::sort(sorted.begin(), sorted.end());
  for (const double share : {0.01, 0.25, 0.5, 0.9, 0.99, 1.0}) {
    const auto index = static_cast<std::size_t>(share * 5000.0 + 0.5) - 1;
    const auto found = latency.quantile(share).count();
    EXPECT_GE(found, sorted[index]) << share;
    EXPECT_LE(static_cast<double>(found), static_cast<double>(sorted[index]) * (1.0 + 1.0 / 32) + 1) << share;
  }
  EXPECT_EQ(latency.worst().count(), sorted.back());
  EXPECT_EQ(latency.count(), 5000u);
}

TEST(Latency, TimeThatWentBackCountsAsNone) {
  Latency latency;
  latency.add(nanoseconds(-5));
  EXPECT_EQ(latency.worst().count(), 0);
}

}  // namespace
}  // namespace hallway::robot
