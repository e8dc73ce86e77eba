// SPDX-License-Identifier: MIT
#include "study/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"

namespace hallway::study {
namespace {

TEST(Median, IsTheMiddle) {
  EXPECT_EQ(median({}), std::nullopt);
  EXPECT_EQ(median({3.0}), 3.0);
  EXPECT_EQ(median({9.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 9.0}), 3.0);
}

TEST(Student, AgreesWithTables) {
  const std::vector<std::pair<int, double>> table{{1, 12.706}, {2, 4.303}, {3, 3.182},  {4, 2.776},
                                                  {5, 2.571},  {9, 2.262}, {18, 2.101}, {100, 1.984}};
  for (const auto& [freedom, value] : table)
    EXPECT_NEAR(student_975(freedom), value, 1.1e-3 * value) << freedom;
}

TEST(MeanInterval, OfThreeValues) {
  const std::vector<double> values{1.0, 2.0, 3.0};  // standard deviation 1
  const auto interval = mean_interval(values);
  ASSERT_TRUE(interval);
  EXPECT_DOUBLE_EQ(interval->value, 2.0);
  EXPECT_NEAR(interval->high - 2.0, 4.30265 / std::sqrt(3.0), 1e-4);
  EXPECT_NEAR(interval->low + interval->high, 4.0, 1e-12);
  EXPECT_FALSE(mean_interval(std::vector<double>{1.0}));
}

TEST(FitLine, FindsALineAndHowSureItIs) {
  const std::vector<Vec2> exact{{0.0, 1.0}, {1.0, 3.0}, {4.0, 9.0}};
  const auto fit = fit_line(exact);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->slope, 2.0, 1e-12);
  EXPECT_NEAR(fit->intercept, 1.0, 1e-12);
  EXPECT_NEAR(fit->slope_half_width, 0.0, 1e-6);
  EXPECT_FALSE(fit_line(std::vector<Vec2>{{1.0, 2.0}, {1.0, 3.0}}));
  EXPECT_FALSE(fit_line(std::vector<Vec2>{{1.0, 2.0}}));
}

TEST(FitLine, ItsIntervalHoldsTheSlopeNineteenTimesOfTwenty) {
  const Random random(5, stream_id("line"));
  int held = 0;
  for (std::uint32_t trial = 0; trial < 2000; ++trial) {
    std::vector<Vec2> points;
    for (std::uint64_t i = 0; i < 8; ++i)
      points.emplace_back(static_cast<double>(i), 0.3 * static_cast<double>(i) + random.normal(trial, i));
    const auto fit = fit_line(points);
    if (std::abs(fit->slope - 0.3) <= fit->slope_half_width) ++held;
  }
  EXPECT_NEAR(held / 2000.0, 0.95, 0.015);  // three standard deviations
}

TEST(ShareInterval, IsWilsons) {
  // The example of Newcombe, "Two-sided confidence intervals for the single proportion", 1998, table I.
  const auto some = share_interval(81, 263);
  ASSERT_TRUE(some);
  EXPECT_NEAR(some->low, 0.2553, 5e-5);
  EXPECT_NEAR(some->high, 0.3662, 5e-5);
  EXPECT_NEAR(share_interval(0, 20)->high, 0.1611, 5e-5);
  EXPECT_EQ(share_interval(0, 20)->low, 0.0);
  EXPECT_EQ(share_interval(29, 29)->high, 1.0);
  EXPECT_NEAR(share_interval(1, 29)->low, 0.0061, 5e-5);
  EXPECT_FALSE(share_interval(0, 0));
}

TEST(FitPower, FindsTheExponent) {
  std::vector<Vec2> points{{0.0, 1.0}, {1.0, -1.0}};  // those do not count
  for (const double x : {1.0, 3.0, 10.0, 50.0}) points.emplace_back(x, 0.2 * std::pow(x, 1.25));
  const auto fit = fit_power(points);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->slope, 1.25, 1e-12);
}

TEST(FitRootWithFloor, FindsScaleAndFloor) {
  std::vector<Vec2> points;
  for (int k = 1; k <= 40; ++k) points.emplace_back(k, std::hypot(0.01 / std::sqrt(k), 0.002));
  const auto fit = fit_root_with_floor(points);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->scale, 0.01, 1e-9);
  EXPECT_NEAR(fit->floor, 0.002, 1e-9);
}

TEST(FitRootWithFloor, HasNoImaginaryFloor) {
  std::vector<Vec2> points;
  for (int k = 1; k <= 40; ++k) points.emplace_back(k, 0.01 / k);  // falls faster than a root
  const auto fit = fit_root_with_floor(points);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->floor, 0.0);
  EXPECT_GT(fit->scale, 0.0);
  EXPECT_FALSE(fit_root_with_floor(std::vector<Vec2>{{1.0, 1.0}, {2.0, 0.5}}));
}

}  // namespace
}  // namespace hallway::study
