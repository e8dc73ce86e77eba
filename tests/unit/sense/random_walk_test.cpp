// SPDX-License-Identifier: MIT
#include "sense/random_walk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace hallway::sense {
namespace {

constexpr double kSigma = 0.3, kInterval_s = 0.005;
constexpr int kValues = 1'000'000;

RandomWalk walk(std::uint64_t seed, std::uint32_t step = 0) {
  return {Random(seed, stream_id("test.walk")), step, kSigma, kInterval_s};
}

/// W_0 … W_n of a walk.
std::vector<double> values(const RandomWalk& w, int n) {
  std::vector<double> all;
  for (int k = 0; k <= n; ++k) all.push_back(w.value(static_cast<std::uint64_t>(k)));
  return all;
}

TEST(RandomWalk, IncrementsAreIndependentAndNormal) {
  const std::vector<double> w = values(walk(1), kValues);
  EXPECT_EQ(w[0], 0.0);
  const double variance = kSigma * kSigma * kInterval_s;
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  for (std::size_t k = 0; k < kValues; ++k) {
    const double d = (w[k + 1] - w[k]) / std::sqrt(variance);
    sum += d;
    squares += d * d;
    fourths += d * d * d * d;
  }
  const double root = std::sqrt(kValues);
  EXPECT_NEAR(sum / kValues, 0.0, 3.0 / root);
  EXPECT_NEAR(squares / kValues, 1.0, 3.0 * std::sqrt(2.0) / root);
  EXPECT_NEAR(fourths / kValues, 3.0, 3.0 * std::sqrt(96.0) / root);
  // At short distances, and at those of the dyadic intervals.
  for (const std::size_t lag : {1u, 2u, 3u, 4u, 7u, 8u, 64u, 1024u, 65536u}) {
    double product = 0.0;
    const std::size_t n = kValues - lag;
    for (std::size_t k = 0; k < n; ++k) product += (w[k + 1] - w[k]) * (w[k + lag + 1] - w[k + lag]);
    EXPECT_NEAR(product / static_cast<double>(n) / variance, 0.0, 3.0 / std::sqrt(n)) << lag;
  }
}

TEST(RandomWalk, SpreadsWithTheRootOfTime) {
  constexpr std::uint64_t kSeeds = 20'000;
  for (const std::uint64_t k : {1u, 2u, 3u, 5u, 8u, 1000u, 4095u}) {
    double squares = 0.0;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) squares += std::pow(walk(seed).value(k), 2);
    const double variance = kSigma * kSigma * kInterval_s * static_cast<double>(k);
    EXPECT_NEAR(squares / kSeeds, variance, 3.0 * variance * std::sqrt(2.0 / kSeeds)) << k;
  }
}

TEST(RandomWalk, IsTheSameInAnyOrder) {
  const std::vector<double> forward = values(walk(5), 3000);
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 5000; ++trial) {
    const std::size_t k = random() % forward.size();
    EXPECT_EQ(walk(5).value(k), forward[k]);
  }
  EXPECT_NE(walk(5).value(7), walk(6).value(7));
  EXPECT_NE(walk(5, 0).value(7), walk(5, 1).value(7));
}

TEST(RandomWalk, ReachesTheLastNumber) {
  constexpr std::uint64_t kLast = std::numeric_limits<std::uint64_t>::max();
  const double size = kSigma * std::sqrt(kInterval_s) * 0x1p32;
  EXPECT_LT(std::abs(walk(1).value(kLast)), 10.0 * size);
  EXPECT_TRUE(std::isfinite(walk(1).value(kLast / 2 + 1)));
  // 1 MHz for eleven days: neighbours still differ by increments.
  constexpr std::uint64_t kLate = 1'000'000'000'000;
  double squares = 0.0;
  for (std::uint64_t k = 0; k < 1000; ++k)
    squares += std::pow(walk(1).value(kLate + k + 1) - walk(1).value(kLate + k), 2);
  EXPECT_NEAR(squares / 1000.0 / (kSigma * kSigma * kInterval_s), 1.0, 3.0 * std::sqrt(2.0 / 1000.0));
}

TEST(RandomWalk, OfNoSizeIsZero) {
  const Random random(1, stream_id("test.walk"));
  EXPECT_EQ(RandomWalk(random, 0, 0.0, 1.0).value(12345), 0.0);
  EXPECT_EQ(RandomWalk(random, 0, 1.0, 0.0).value(12345), 0.0);
}

}  // namespace
}  // namespace hallway::sense
