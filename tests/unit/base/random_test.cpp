// SPDX-License-Identifier: MIT
#include "base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "support/long_mode.hpp"

namespace hallway {
namespace {

using Words = std::array<std::uint32_t, 4>;

/// Random's numbers for Philox's counter and key words.
Words philox(const Words& counter, std::uint32_t key0, std::uint32_t key1) {
  const Random random((std::uint64_t{key1} << 32) | key0, counter[3]);
  return random.bits(counter[2], (std::uint64_t{counter[1]} << 32) | counter[0]);
}

// The vectors "philox4x32 10" of tests/kat_vectors in Random123.
TEST(RandomBits, AreThePublishedOnesForZeros) {
  EXPECT_EQ(philox({0, 0, 0, 0}, 0, 0), (Words{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}));
}

TEST(RandomBits, AreThePublishedOnesForOnes) {
  constexpr std::uint32_t kOnes = 0xffffffffu;
  EXPECT_EQ(philox({kOnes, kOnes, kOnes, kOnes}, kOnes, kOnes),
            (Words{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}));
}

TEST(RandomBits, AreThePublishedOnesForTheDigitsOfPi) {
  EXPECT_EQ(philox({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, 0xa4093822u, 0x299f31d0u),
            (Words{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u}));
}

TEST(RandomBits, ChangeWithSeedStreamStepAndIndex) {
  const std::set<Words> all{Random(1, 2).bits(3, 4),
                            Random(2, 2).bits(3, 4),
                            Random(1 + (1ull << 32), 2).bits(3, 4),
                            Random(1, 3).bits(3, 4),
                            Random(1, 2).bits(4, 4),
                            Random(1, 2).bits(3, 5),
                            Random(1, 2).bits(3, 4 + (1ull << 32))};
  EXPECT_EQ(all.size(), 7u);
}

TEST(StreamId, IsFnv1a) {  // published test vectors of the 32-bit FNV-1a
  EXPECT_EQ(stream_id(""), 0x811c9dc5u);
  EXPECT_EQ(stream_id("a"), 0xe40c292cu);
  EXPECT_EQ(stream_id("foobar"), 0xbf9cf968u);
}

TEST(RandomUniform, FillsTheUnitIntervalEvenly) {
  const int n = test::sized(100'000, 10'000'000);
  const Random random(7, stream_id("test"));
  std::array<int, 20> bins{};
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform(3, static_cast<std::uint64_t>(i));
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[static_cast<std::size_t>(u * 20.0)];
  }
  double chi_squared = 0.0;
  const double expected = n / 20.0;
  for (const int count : bins) chi_squared += (count - expected) * (count - expected) / expected;
  EXPECT_LT(chi_squared, 43.8);  // 99.9 % of 19 degrees of freedom
  EXPECT_GT(chi_squared, 5.4);   // 0.1 %: too even is wrong too
}

TEST(RandomUniform, StaysBelowTheUpperEnd) {
  // Between two neighbouring doubles every sum above the middle rounds to the upper one.
  const double low = 1.0;
  const double high = std::nextafter(1.0, 2.0);
  const Random random(7, 1);
  for (std::uint64_t i = 0; i < 100; ++i) EXPECT_EQ(random.uniform(0, i, low, high), low);
}

TEST(RandomUniform, ScalesToTheInterval) {
  const Random random(7, 1);
  for (std::uint64_t i = 0; i < 100; ++i) {
    EXPECT_DOUBLE_EQ(random.uniform(0, i, -2.0, 6.0), -2.0 + 8.0 * random.uniform(0, i));
  }
}

std::vector<double> normals(int n, std::uint32_t step) {
  const Random random(11, stream_id("normal"));
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(random.normal(step, static_cast<std::uint64_t>(i)));
  return values;
}

TEST(RandomNormal, HasTheMomentsOfTheStandardNormal) {
  const int n = test::sized(200'000, 20'000'000);
  std::array<double, 5> moment{};
  for (const double x : normals(n, 0)) {
    double power = 1.0;
    for (double& m : moment) m += power, power *= x;
  }
  const double root = std::sqrt(static_cast<double>(n));
  // The standard deviations of the first four sample moments are 1, sqrt(2), sqrt(15) and sqrt(96) over sqrt(n).
  EXPECT_NEAR(moment[1] / n, 0.0, 4.0 * 1.0 / root);
  EXPECT_NEAR(moment[2] / n, 1.0, 4.0 * std::sqrt(2.0) / root);
  EXPECT_NEAR(moment[3] / n, 0.0, 4.0 * std::sqrt(15.0) / root);
  EXPECT_NEAR(moment[4] / n, 3.0, 4.0 * std::sqrt(96.0) / root);
}

TEST(RandomNormal, FollowsTheDistributionFunction) {  // Kolmogorov-Smirnov
  const int n = test::sized(100'000, 5'000'000);
  std::vector<double> values = normals(n, 1);
  std::sort(values.begin(), values.end());
  double farthest = 0.0;
  for (int i = 0; i < n; ++i) {
    const double expected = 0.5 * std::erfc(-values[static_cast<std::size_t>(i)] / std::sqrt(2.0));
    farthest = std::max({farthest, std::abs(expected - static_cast<double>(i) / n),
                         std::abs(expected - static_cast<double>(i + 1) / n)});
  }
  EXPECT_LT(farthest, 1.95 / std::sqrt(static_cast<double>(n)));  // 99.9 %
}

TEST(RandomNormal, NeighbouringNumbersAreNotCorrelated) {
  const int n = test::sized(100'000, 5'000'000);
  const std::vector<double> step0 = normals(n, 2);
  const std::vector<double> step1 = normals(n, 3);
  double along = 0.0;
  double across = 0.0;
  for (std::size_t i = 1; i < step0.size(); ++i) {
    along += step0[i - 1] * step0[i];
    across += step0[i] * step1[i];
  }
  EXPECT_NEAR(along / n, 0.0, 4.0 / std::sqrt(static_cast<double>(n)));
  EXPECT_NEAR(across / n, 0.0, 4.0 / std::sqrt(static_cast<double>(n)));
}

struct Quantile {
  double p;
  double x;
};

// Roots of Phi(x) = p for the exact value of each double p, computed with 400 decimal digits (series and Newton steps).
constexpr std::array<Quantile, 24> kQuantiles{{
    {1e-300, -37.047096299361199237},       {1e-100, -21.273453560965324294},
    {1e-20, -9.2623400897984075796},        {2.0e-13, -7.2555611541276993576},
    {1e-12, -7.0344838253011319326},        {1e-5, -4.2648907939228246102},
    {0.001, -3.0902323061678135354},        {0.02425, -1.9729610513118848376},
    {0.074, -1.4466320671589785099},        {0.0750000000001, -1.4395314709377494743},
    {0.076, -1.4325027208258116188},        {0.1, -1.2815515655446004353},
    {0.25, -0.67448975019608174320},        {0.4, -0.25334710313579974132},
    {0.49999, -0.000025066282748960008527}, {0.5, 0.0},
    {0.6, 0.25334710313579974132},          {0.75, 0.67448975019608174320},
    {0.9, 1.2815515655446005935},           {0.925, 1.4395314709384562291},
    {0.95, 1.6448536269514722843},          {0.99, 2.3263478740408407676},
    {0.999999, 4.7534243088170877657},      {0.9999999999, 6.3613408896974218642},
}};

TEST(InverseNormalCdf, AgreesWithTheExactQuantiles) {
  for (const Quantile& quantile : kQuantiles) {
    EXPECT_NEAR(inverse_normal_cdf(quantile.p), quantile.x, 1e-14 * std::abs(quantile.x)) << quantile.p;
  }
}

TEST(InverseNormalCdf, UndoesTheDistributionFunction) {
  for (double x = -8.0; x <= 4.0; x += 0.01) {
    const double p = 0.5 * std::erfc(-x / std::sqrt(2.0));
    // What half an ulp of p is in x, beside the relative error of both functions.
    const double slope = std::exp(-0.5 * x * x) / std::sqrt(2.0 * 3.14159265358979323846);
    EXPECT_NEAR(inverse_normal_cdf(p), x, 1e-13 + p * 4e-16 / slope) << x;
  }
}

TEST(InverseNormalCdf, NeverFalls) {
  double before = -std::numeric_limits<double>::infinity();
  for (int i = 1; i < 200'000; ++i) {
    const double x = inverse_normal_cdf(i / 200'000.0);
    ASSERT_GE(x, before) << i;
    before = x;
  }
}

TEST(InverseNormalCdf, IsFiniteAtTheEndsThatNormalUses) {
  EXPECT_NEAR(inverse_normal_cdf(0x1.0p-53), -8.2095361516013855, 1e-12);
  EXPECT_NEAR(inverse_normal_cdf(1.0 - 0x1.0p-53), 8.2095361516013855, 1e-12);
}

}  // namespace
}  // namespace hallway
