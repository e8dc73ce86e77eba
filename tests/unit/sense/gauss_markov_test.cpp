// SPDX-License-Identifier: MIT
#include "sense/gauss_markov.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hallway::sense {
namespace {

constexpr double kSigma = 1.7, kTau_s = 20.0, kInterval_s = 0.5;

GaussMarkov process(std::uint64_t seed, double tau_s = kTau_s, double interval_s = kInterval_s) {
  return {Random(seed, stream_id("test.markov")), 0, kSigma, tau_s, interval_s};
}

TEST(GaussMarkov, FadesWithItsCorrelationTime) {
  constexpr std::uint64_t kSeeds = 20'000;
  // Within an octave and across their ends.
  for (const std::uint64_t k : {0u, 1u, 2u, 3u, 7u, 8u, 100u, 1023u}) {
    for (const std::uint64_t lag : {0u, 1u, 2u, 5u, 40u, 100u}) {
      double product = 0.0, fourth = 0.0;
      for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        const GaussMarkov x = process(seed);
        const double both = x.value(k) * x.value(k + lag);
        product += both;
        fourth += both * both;
      }
      const double expected = kSigma * kSigma * std::exp(-static_cast<double>(lag) * kInterval_s / kTau_s);
      const double mean = product / kSeeds;
      const double sigma = std::sqrt((fourth / kSeeds - mean * mean) / kSeeds);
      EXPECT_NEAR(mean, expected, 3.7 * sigma) << k << " and " << lag << " later";  // of 48 that are tried
    }
  }
}

/// A first-order process has innovations that are independent of all before.
TEST(GaussMarkov, InnovationsAreIndependentAndNormal) {
  constexpr int kValues = 1'000'000;
  const GaussMarkov x = process(1);
  const double r = std::exp(-kInterval_s / kTau_s), scale = kSigma * std::sqrt(1.0 - r * r);
  std::vector<double> z;
  double before = x.value(0);
  for (int k = 1; k <= kValues; ++k) {
    const double now = x.value(static_cast<std::uint64_t>(k));
    z.push_back((now - r * before) / scale);
    before = now;
  }
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  for (const double one : z) {
    sum += one;
    squares += one * one;
    fourths += one * one * one * one;
  }
  const double root = std::sqrt(kValues);
  EXPECT_NEAR(sum / kValues, 0.0, 3.0 / root);
  EXPECT_NEAR(squares / kValues, 1.0, 3.0 * std::sqrt(2.0) / root);
  EXPECT_NEAR(fourths / kValues, 3.0, 3.0 * std::sqrt(96.0) / root);
  for (const std::size_t lag : {1u, 2u, 3u, 4u, 8u, 64u, 1024u}) {
    double product = 0.0;
    for (std::size_t k = 0; k + lag < z.size(); ++k) product += z[k] * z[k + lag];
    EXPECT_NEAR(product / static_cast<double>(z.size() - lag), 0.0, 3.5 / root) << lag;
  }
}

TEST(GaussMarkov, OrderOfCallsChangesNothing) {
  const GaussMarkov x = process(3);
  const double later = x.value(123'456'789);
  x.value(5);
  EXPECT_EQ(x.value(123'456'789), later);
}

TEST(GaussMarkov, EndsOfItsRange) {
  const GaussMarkov white = process(4, 0.0);
  EXPECT_NE(white.value(1), white.value(2));
  const GaussMarkov constant = process(4, kTau_s, 0.0);
  EXPECT_EQ(constant.value(1), constant.value(1000));
  EXPECT_EQ(GaussMarkov(Random(1, 2), 0, 0.0, 1.0, 1.0).value(9), 0.0);
  EXPECT_TRUE(std::isfinite(process(4, 1e300).value(77)));
  EXPECT_TRUE(std::isfinite(process(4, 1e-300).value(77)));
}

}  // namespace
}  // namespace hallway::sense
