// SPDX-License-Identifier: MIT
#include "sense/sensor_clock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace hallway::sense {
namespace {

constexpr std::int64_t kInterval_ns = 5'000'000;
constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

TEST(SensorClock, WithoutErrorsIsTheRobots) {
  const SensorClock clock("imu", {}, kInterval_ns, 1);
  for (const std::int64_t t_ns :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{1'000'000'000'000'001}, kMost})
    EXPECT_EQ(clock.stamp(7, t_ns), t_ns);
}

TEST(SensorClock, HasItsOffsetAndDrift) {
  const SensorClock clock("imu", {.offset_s = -2.5, .drift_ppm = 40.0}, kInterval_ns, 1);
  EXPECT_EQ(clock.stamp(0, 0), -2'500'000'000);
  EXPECT_EQ(clock.stamp(3, 1'000'000'000'000), 1'000'000'000'000 + 40'000'000 - 2'500'000'000);
}

TEST(SensorClock, DriftsExactlyLateInARun) {
  // Exact in binary: 1.5 / 1024 ppm are 1.46484375 ns a second.
  const SensorClock clock("imu", {.drift_ppm = 1.5 / 1024.0}, kInterval_ns, 1);
  const std::int64_t late_ns = 1'024'000'000'000'000'000 + 123;
  EXPECT_EQ(clock.stamp(0, late_ns), late_ns + 1'500'000'000);
  const SensorClock slow("imu", {.drift_ppm = -50'000.0}, kInterval_ns, 1);
  EXPECT_EQ(slow.stamp(0, 8'000'000'000'000'000'020), 7'600'000'000'000'000'019);
}

TEST(SensorClock, HasTheDeclaredStatistics) {
  constexpr double kJitter_ns = 20'000.0;
  const SensorClock clock("imu", {.offset_s = 0.25, .drift_ppm = -30.0, .jitter_s = 1e-9 * kJitter_ns},
                          kInterval_ns, 1);
  constexpr int kStamps = 1'000'000;
  // Regression of what the stamp differs by, over the number less its mean.
  double sum = 0.0, product = 0.0, squares = 0.0, products_of_neighbours = 0.0, last = 0.0;
  constexpr double kMiddle = 0.5 * (kStamps - 1);
  for (int k = 0; k < kStamps; ++k) {
    const std::int64_t t_ns = k * kInterval_ns;
    const double difference = static_cast<double>(clock.stamp(static_cast<std::uint64_t>(k), t_ns) - t_ns);
    sum += difference;
    product += (k - kMiddle) * difference;
    const double rest = difference - 0.25e9 + 30e-6 * static_cast<double>(t_ns);
    EXPECT_LE(std::abs(rest), 4.0 * kJitter_ns + 1.0);
    squares += rest * rest;
    products_of_neighbours += rest * last;
    last = rest;
  }
  const double spread = static_cast<double>(kStamps) * (static_cast<double>(kStamps) * kStamps - 1.0) / 12.0;
  const double slope = product / spread / kInterval_ns;
  EXPECT_NEAR(slope, -30e-6, 3.0 * kJitter_ns / std::sqrt(spread) / kInterval_ns);
  EXPECT_NEAR(sum / kStamps - slope * kMiddle * kInterval_ns, 0.25e9,
              3.0 * 2.0 * kJitter_ns / std::sqrt(kStamps));
  const double variance = kJitter_ns * kJitter_ns;
  EXPECT_NEAR(squares / kStamps, variance, 3.0 * variance * std::sqrt(2.0 / kStamps));
  EXPECT_NEAR(products_of_neighbours / kStamps, 0.0, 3.0 * variance / std::sqrt(kStamps));
}

TEST(SensorClock, NeverRunsBackwards) {
  for (const std::int64_t interval_ns : {0L, 1L, 2L, 3L, 1000L, 5'000'000L}) {
    for (const double drift_ppm : {0.0, 1e5, -1e5, -12.3}) {
      for (const std::int64_t start_ns : {0L, 1'000'000'000'000'000L, 8'000'000'000'000'000'000L}) {
        const SensorClock clock("imu", {.offset_s = 1.0, .drift_ppm = drift_ppm, .jitter_s = 1.0},
                                interval_ns, 9);
        std::int64_t last = std::numeric_limits<std::int64_t>::min();
        for (std::uint64_t k = 0; k < 2000; ++k) {
          const std::int64_t t_ns = start_ns + static_cast<std::int64_t>(k) * interval_ns;
          const std::int64_t stamp = clock.stamp(k, t_ns);
          ASSERT_GE(stamp, last) << interval_ns << " ns, " << drift_ppm << " ppm, " << k;
          last = stamp;
          // The begin of a reading is not after its end.
          ASSERT_LE(clock.stamp(k, t_ns - interval_ns), stamp);
        }
      }
    }
  }
}

TEST(SensorClock, DependsOnSeedSensorAndNumber) {
  const SensorClockSpec spec{.jitter_s = 1e-4};
  const SensorClock a("imu", spec, kInterval_ns, 1), same("imu", spec, kInterval_ns, 1);
  const SensorClock seed("imu", spec, kInterval_ns, 2), name("lidar", spec, kInterval_ns, 1);
  EXPECT_EQ(a.stamp(5, 100), same.stamp(5, 100));
  EXPECT_NE(a.stamp(5, 100), a.stamp(6, 100));
  EXPECT_NE(a.stamp(5, 100), seed.stamp(5, 100));
  EXPECT_NE(a.stamp(5, 100), name.stamp(5, 100));
}

TEST(SensorClock, StaysWithin64Bits) {
  const SensorClock fast("imu", {.offset_s = 1e9, .drift_ppm = 1e5}, kInterval_ns, 1);
  EXPECT_EQ(fast.stamp(0, kMost), kMost);
  const SensorClock slow("imu", {.offset_s = -1e9}, kInterval_ns, 1);
  EXPECT_EQ(slow.stamp(0, -kMost), std::numeric_limits<std::int64_t>::min());
}

TEST(SensorClock, RefusesBadInput) {
  const auto refusal = [](const SensorClockSpec& spec,
                          std::int64_t interval_ns = kInterval_ns) -> std::string {
    try {
      const SensorClock clock("wrist", spec, interval_ns, 1);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kBadInput);
      return error.what();
    }
    return "";
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find("wrist") != std::string::npos && text.find(part) != std::string::npos;
  };
  EXPECT_PRED2(has, refusal({.offset_s = INFINITY}), "offset_s");
  EXPECT_PRED2(has, refusal({.drift_ppm = std::nan("")}), "drift_ppm");
  EXPECT_PRED2(has, refusal({.drift_ppm = -1e6}), "drift_ppm");
  EXPECT_PRED2(has, refusal({.jitter_s = -1.0}), "jitter_s");
  EXPECT_PRED2(has, refusal({}, -1), "interval");
}

}  // namespace
}  // namespace hallway::sense
