// SPDX-License-Identifier: MIT
#include "sense/timing.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hallway::sense {
namespace {

constexpr std::int64_t kPeriod_ns = 100'000'000;

TEST(ReadingClock, WithoutARateGivesOneReadingForEveryFrame) {
  const ReadingClock clock({}, kPeriod_ns);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    EXPECT_EQ(clock.time_of(i), static_cast<std::int64_t>(i) * kPeriod_ns);
    EXPECT_EQ(clock.arrived_by(static_cast<std::int64_t>(i) * kPeriod_ns), i + 1);
  }
}

TEST(ReadingClock, CountsWhatHasArrivedAsCountingOneByOneDoes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const SensorTiming timing{.rate_hz = trial % 7 == 0 ? 0.0 : 0.1 + 1000.0 * uniform(random),
                              .phase_s = trial % 3 == 0 ? 0.0 : uniform(random),
                              .latency_s = trial % 2 == 0 ? 0.0 : 0.5 * uniform(random)};
    const ReadingClock clock(timing, kPeriod_ns);
    const std::int64_t latency_ns = std::llround(timing.latency_s * 1e9);
    std::uint64_t arrived = 0;
    for (std::int64_t t_ns = 0; t_ns < 3'000'000'000; t_ns += kPeriod_ns) {
      while (clock.time_of(arrived) + latency_ns <= t_ns) ++arrived;
      ASSERT_EQ(clock.arrived_by(t_ns), arrived) << timing.rate_hz << " Hz at " << t_ns;
    }
  }
}

TEST(ReadingClock, ARateThatNobodyLivesToSeeGivesTheFirstReading) {
  for (const double rate_hz : {1e-12, 5e-324, 1e-9, 1e-3}) {
    const ReadingClock clock({.rate_hz = rate_hz}, kPeriod_ns);
    EXPECT_EQ(clock.arrived_by(0), 1u) << rate_hz;
    EXPECT_EQ(clock.arrived_by(3'600'000'000'000), rate_hz < 2e-4 ? 1u : 4u) << rate_hz;
    EXPECT_GE(clock.time_of(UINT64_MAX), clock.time_of(1)) << rate_hz;
  }
}

TEST(ReadingClock, AReadingThatArrivesWithAFrameIsInIt) {
  const ReadingClock clock({.rate_hz = 20.0, .latency_s = 0.05}, kPeriod_ns);
  EXPECT_EQ(clock.arrived_by(49'999'999), 0u);
  EXPECT_EQ(clock.arrived_by(50'000'000), 1u);
  EXPECT_EQ(clock.arrived_by(100'000'000), 2u);
}

/// What takes time arrives when it has ended, at any rate.
TEST(ReadingClock, ReadingsThatTakeTimeArriveAtTheirEnd) {
  constexpr std::int64_t kFrame_ns = 100'000'000;
  for (const double rate_hz : {1e-12, 1e-3, 0.0, 3.0, 7.3, 200.0, 1e4}) {
    const SensorTiming timing{.rate_hz = rate_hz, .phase_s = 0.013, .latency_s = 0.021};
    const std::int64_t interval = interval_ns(timing, kFrame_ns);
    EXPECT_GT(interval, 0) << rate_hz;
    for (const ReadingSpan& span : {ReadingSpan{.duration_ns = interval}, ReadingSpan{.to_next = true}}) {
      const ReadingClock clock(timing, kFrame_ns, span);
      std::uint64_t arrived = 0;
      for (std::int64_t t_ns = 0; t_ns < 40 * kFrame_ns; t_ns += kFrame_ns) {
        while (clock.end_of(arrived) + 21'000'000 <= t_ns) ++arrived;
        ASSERT_EQ(clock.arrived_by(t_ns), arrived) << rate_hz << " Hz at " << t_ns;
      }
      if (rate_hz == 0.0) continue;
      EXPECT_GE(clock.end_of(UINT64_MAX - 1), clock.end_of(0)) << rate_hz;
    }
  }
}

}  // namespace
}  // namespace hallway::sense
