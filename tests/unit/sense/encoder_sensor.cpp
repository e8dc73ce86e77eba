// SPDX-License-Identifier: MIT
#include "sense/encoder_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace hallway::sense {
namespace {

EncoderSensorSpec plain_encoder() {
  return {.name = "wheels", .ticks_per_revolution = 500.0, .wheel_radius_m = 0.04};
}

TEST(EncoderSensor, ManySmallStepsDoNotDrift) {
  const EncoderSensor encoder(plain_encoder(), 1, 1);
  const double tick = plain_encoder().nominal_m_per_tick();
  std::int64_t last = 0;
  constexpr std::int64_t kSteps = 10'000'000;
  for (std::int64_t k = 1; k <= kSteps; ++k) {
    const double way = static_cast<double>(k) * 1e-6;
    const std::int64_t ticks = encoder.read({&way, 1}).ticks[0];
    if (ticks < last || ticks > last + 1) FAIL() << "step " << k;
    last = ticks;
  }
  EXPECT_EQ(last, static_cast<std::int64_t>(std::floor(10.0 / tick)));
  EXPECT_NEAR(static_cast<double>(last) * tick, 10.0, tick);
}

TEST(EncoderSensor, IsWithinATickOfTheWay) {
  EncoderSensorSpec spec = plain_encoder();
  spec.radius_error = {0.01, -0.02};
  const EncoderSensor encoder(spec, 2, 1);
  EXPECT_DOUBLE_EQ(encoder.m_per_tick()[0], 1.01 * spec.nominal_m_per_tick());
  EXPECT_DOUBLE_EQ(encoder.m_per_tick()[1], 0.98 * spec.nominal_m_per_tick());
  const std::vector<std::int64_t> there = encoder.read(std::vector{1.234, -1.234}).ticks;
  for (const double way : {-50.0, -1e-9, 0.0, 3e-5, 0.7, 1e4}) {
    const std::vector<double> ways{way, -way};
    const EncoderReading reading = encoder.read(ways);
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      const double left =
          ways[wheel] - static_cast<double>(reading.ticks[wheel]) * encoder.m_per_tick()[wheel];
      EXPECT_GE(left, -1e-11);
      EXPECT_LT(left, encoder.m_per_tick()[wheel] + 1e-11);
    }
    EXPECT_EQ(encoder.truth(ways).travel_m, ways);
  }
  EXPECT_EQ(encoder.read(std::vector{1.234, -1.234}).ticks, there);
}

TEST(EncoderSensor, RadiusErrorsHaveTheirStatistics) {
  EncoderSensorSpec spec = plain_encoder();
  spec.radius_error = {0.02};
  spec.radius_error_sigma = 0.01;
  constexpr int kSeeds = 20'000;
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const EncoderSensor encoder(spec, 1, seed);
    const double error = encoder.m_per_tick()[0] / spec.nominal_m_per_tick() - 1.02;
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / kSeeds, 0.0, 3.0 * 0.01 / std::sqrt(kSeeds));
  EXPECT_NEAR(squares / kSeeds, 1e-4, 3.0 * 1e-4 * std::sqrt(2.0 / kSeeds));
  const EncoderSensor two(spec, 2, 7), three(spec, 3, 7);
  EXPECT_EQ(two.m_per_tick()[1], three.m_per_tick()[1]);
}

TEST(EncoderSensor, CountsSaturate) {
  const EncoderSensor encoder(plain_encoder(), 2, 1);
  const EncoderReading reading = encoder.read(std::vector{1e300, -1e300});
  EXPECT_EQ(reading.ticks[0], std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(reading.ticks[1], std::numeric_limits<std::int64_t>::min());
}

TEST(EncoderSensor, RefusesBadInput) {
  const EncoderSensor encoder(plain_encoder(), 2, 1);
  EXPECT_THROW(encoder.read(std::vector{1.0}), Error);
  EXPECT_THROW(encoder.read(std::vector{1.0, std::nan("")}), Error);
  const auto refused = [](auto change) {
    EncoderSensorSpec spec = plain_encoder();
    change(spec);
    EXPECT_THROW(EncoderSensor(spec, 2, 1), Error);
  };
  refused([](EncoderSensorSpec& spec) { spec.name.clear(); });
  refused([](EncoderSensorSpec& spec) { spec.ticks_per_revolution = 0.0; });
  refused([](EncoderSensorSpec& spec) { spec.wheel_radius_m = INFINITY; });
  refused([](EncoderSensorSpec& spec) { spec.radius_error_sigma = 0.2; });
  refused([](EncoderSensorSpec& spec) { spec.radius_error = {0.0, 0.0, 0.0}; });
  refused([](EncoderSensorSpec& spec) { spec.radius_error = {0.6}; });
}

}  // namespace
}  // namespace hallway::sense
