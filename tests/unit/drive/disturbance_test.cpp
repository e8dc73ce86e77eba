// SPDX-License-Identifier: MIT
#include "drive/disturbance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "unit/drive/drives.hpp"

namespace hallway::drive {
namespace {

constexpr std::size_t kSamples = 1'000'000;

std::vector<double> knots(const Disturbance& disturbance, std::size_t count, std::uint64_t seed,
                          const char* stream) {
  DisturbanceProcess process(disturbance, seed, stream);
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = process.at(static_cast<std::int64_t>(i) * kKnotNs);
  return values;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Mean product of the deviations of two sequences, the second one later by `lag`.
double covariance(const std::vector<double>& a, double mean_a, const std::vector<double>& b, double mean_b,
                  std::size_t lag = 0) {
  double sum = 0.0;
  for (std::size_t i = 0; i + lag < a.size(); ++i) sum += (a[i] - mean_a) * (b[i + lag] - mean_b);
  return sum / static_cast<double>(a.size() - lag);
}

/// Mean, deviation and correlation time of the knots, within three standard errors of an autoregressive sequence (Bartlett).
void expect_statistics(const Disturbance& declared, std::uint64_t seed) {
  const std::vector<double> values = knots(declared, kSamples, seed, "drive.left_slip");
  const double n = static_cast<double>(kSamples);
  const double keep =
      declared.correlation_ns == 0 ? 0.0 : std::exp(-1e7 / static_cast<double>(declared.correlation_ns));
  const double variance = declared.sigma * declared.sigma;
  const double mean = mean_of(values);
  EXPECT_NEAR(mean, declared.mean, 3.0 * declared.sigma * std::sqrt((1.0 + keep) / (1.0 - keep) / n));
  const double keep2 = keep * keep;
  const double found = covariance(values, declared.mean, values, declared.mean);
  EXPECT_NEAR(found, variance, 3.0 * variance * std::sqrt(2.0 * (1.0 + keep2) / (1.0 - keep2) / n));
  const auto lag = std::max<std::size_t>(1, static_cast<std::size_t>(declared.correlation_ns / kKnotNs));
  const double expected = std::pow(keep, static_cast<double>(lag));
  const double error = std::sqrt(((1.0 + keep2) * (1.0 - expected * expected) / (1.0 - keep2) -
                                  2.0 * static_cast<double>(lag) * expected * expected) /
                                 n);
  EXPECT_NEAR(covariance(values, declared.mean, values, declared.mean, lag) / found, expected, 3.0 * error);
}

TEST(Disturbance, StatisticsAreAsDeclared) {
  expect_statistics({0.1, 0.05, 200'000'000}, 11);
  expect_statistics({-0.02, 0.3, 0}, 12);
}

TEST(Disturbance, WithoutDeviationIsExactlyTheMean) {
  DisturbanceProcess process({0.1, 0.0, 200'000'000}, 1, "drive.left_slip");
  for (const std::int64_t t : {0, 1, 12'345'678}) EXPECT_EQ(process.at(t), 0.1);
}

TEST(Disturbance, ValueDoesNotDependOnWhatWasAsked) {
  const Disturbance disturbance{0.0, 1.0, 100'000'000};
  DisturbanceProcess one(disturbance, 5, "drive.left_slip");
  testing::Dice dice(4);
  for (int i = 0; i < 300; ++i) {
    const std::int64_t t = dice.whole(0, 400) * (i % 2 == 0 ? kKnotNs : 7'654'321);
    DisturbanceProcess fresh(disturbance, 5, "drive.left_slip");
    EXPECT_EQ(one.at(t), fresh.at(t)) << t;
  }
}

TEST(Disturbance, IsLinearBetweenKnots) {
  DisturbanceProcess process({0.5, 1.0, 0}, 6, "drive.left_slip");
  const double a = process.at(30'000'000), b = process.at(40'000'000);
  EXPECT_NEAR(process.at(32'500'000), a + 0.25 * (b - a), 1e-15);
  EXPECT_NEAR(process.at(30'000'001), a, 1e-6);
  EXPECT_NEAR(process.at(39'999'999), b, 1e-6);
}

TEST(Disturbance, SeedsAndStreamsAreKeptApart) {
  const Disturbance disturbance{0.0, 1.0, 0};
  const std::size_t count = 100'000;
  const std::vector<double> first = knots(disturbance, count, 1, "drive.left_slip");
  for (const std::vector<double>& other :
       {knots(disturbance, count, 2, "drive.left_slip"), knots(disturbance, count, 1, "drive.right_slip")}) {
    EXPECT_NE(first[0], other[0]);
    EXPECT_NEAR(covariance(first, 0.0, other, 0.0), 0.0, 4.0 / std::sqrt(static_cast<double>(count)));
  }
  EXPECT_EQ(first, knots(disturbance, count, 1, "drive.left_slip"));
}

}  // namespace
}  // namespace hallway::drive
