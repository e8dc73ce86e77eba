// SPDX-License-Identifier: MIT
#include "study/ticks.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hallway::study {
namespace {

std::vector<std::string> texts(const std::vector<Tick>& ticks) {
  std::vector<std::string> all;
  for (const Tick& tick : ticks) all.push_back(tick.text);
  return all;
}

using Texts = std::vector<std::string>;

TEST(LinearTicks, OfCountsAreWholeNumbers) {
  EXPECT_EQ(texts(linear_ticks({0.0, 2.08}, 8, 1.0)), (Texts{"0", "1", "2"}));
  EXPECT_EQ(linear_ticks({0.0, 40.0}, 8, 1.0).size(), linear_ticks({0.0, 40.0}, 8).size());
}

TEST(LinearTicks, AreRoundNumbers) {
  EXPECT_EQ(texts(linear_ticks({0.0, 10.0}, 6)), (Texts{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(texts(linear_ticks({-0.03, 0.051}, 6)), (Texts{"-0.02", "0.00", "0.02", "0.04"}));
  EXPECT_EQ(texts(linear_ticks({0.0, 3800.0}, 9)),
            (Texts{"0", "500", "1000", "1500", "2000", "2500", "3000", "3500"}));
}

TEST(LinearTicks, LieWithinTheRangeAndAreNotTooMany) {
  for (const double width : {1e-7, 0.003, 0.7, 1.0, 19.0, 12345.0, 1e9}) {
    for (const double low : {-3.3 * width, -0.4 * width, 0.0, 5.1 * width}) {
      const AxisRange range{low, low + width};
      for (int most = 2; most < 12; ++most) {
        const auto ticks = linear_ticks(range, most);
        EXPECT_LE(static_cast<int>(ticks.size()), most);
        for (const Tick& tick : ticks) {
          EXPECT_GE(tick.value, range.low - 1e-8 * width);
          EXPECT_LE(tick.value, range.high + 1e-8 * width);
        }
      }
      EXPECT_GE(linear_ticks(range, 8).size(), 2u) << low << " " << width;
    }
  }
}

TEST(LogTicks, AreDecadesAndBetweenFewOfThemMore) {
  EXPECT_EQ(texts(log_ticks({0.9, 1.1e4}, 8)), (Texts{"1", "10", "100", "1000", "10000"}));
  EXPECT_EQ(texts(log_ticks({0.9, 25.0}, 8)), (Texts{"1", "2", "5", "10", "20"}));
  EXPECT_EQ(texts(log_ticks({0.004, 0.03}, 8)), (Texts{"0.005", "0.01", "0.02"}));
}

TEST(AxisRange, HoldsAllValues) {
  const AxisRange range = axis_range({3.0, -1.0, 7.0}, false);
  EXPECT_LT(range.low, -1.0);
  EXPECT_GT(range.high, 7.0);
  EXPECT_EQ(axis_range({1.0, 10.0}, false).low, 0.0);  // near zero: from zero on
  EXPECT_GT(axis_range({9.0, 10.0}, false).low, 8.0);  // far from it: not
}

TEST(AxisRange, IsSoundWithoutValuesAndWithOne) {
  EXPECT_EQ(axis_range({}, false).high, 1.0);
  EXPECT_EQ(axis_range({NAN, INFINITY}, false).high, 1.0);
  EXPECT_EQ(axis_range({-1.0, 0.0}, true).high, 1.0);
  for (const double value : {-2.0, 0.0, 2.0}) {
    const AxisRange range = axis_range({value}, false);
    EXPECT_LT(range.low, range.high) << value;
    EXPECT_LE(range.low, value);
    EXPECT_GE(range.high, value);
  }
  const AxisRange log = axis_range({0.5, -1.0, 0.0}, true);
  EXPECT_GT(log.low, 0.0);
  EXPECT_LT(log.low, 0.5);
  EXPECT_GT(log.high, 0.5);
}

}  // namespace
}  // namespace hallway::study
