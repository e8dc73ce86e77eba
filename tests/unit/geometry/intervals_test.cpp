// SPDX-License-Identifier: MIT
#include "geometry/intervals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/random.hpp"

namespace hallway {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Intervals = std::vector<Interval>;

bool operator==(const Interval& a, const Interval& b) {
  return a.from == b.from && a.to == b.to;
}

Intervals without(Intervals kept, Intervals taken) {
  subtract(kept, taken);
  return kept;
}

void expect_same(const Intervals& a, const Intervals& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_TRUE(a[i] == b[i]) << i << ": " << a[i].from << " " << a[i].to;
}

TEST(Intervals, LoseWhatIsTaken) {
  expect_same(without({{0, 10}}, {}), {{0, 10}});
  expect_same(without({{0, 10}}, {{2, 3}}), {{0, 2}, {3, 10}});
  expect_same(without({{0, 10}}, {{8, 9}, {2, 3}, {2.5, 4}}), {{0, 2}, {4, 8}, {9, 10}});
  expect_same(without({{0, 10}}, {{-kInfinity, 1}, {9, kInfinity}}), {{1, 9}});
  expect_same(without({{0, 10}}, {{-1, 11}}), {});
  expect_same(without({{0, 1}, {2, 3}, {4, 5}}, {{0.5, 4.5}}), {{0, 0.5}, {4.5, 5}});
  expect_same(without({{0, 10}}, {{1, 9}, {2, 3}, {8, 10}}), {{0, 1}});
}

TEST(Intervals, AreNotSplitByWhatIsEmpty) {
  expect_same(without({{0, 10}}, {{5, 5}, {7, 6}}), {{0, 10}});
}

TEST(Intervals, HaveNoSliverWhereTwoShadowsMeet) {
  const double edge = 1.0 / 3.0;
  expect_same(without({{0, 1}}, {{edge, 1}, {0, edge}}), {});
}

TEST(Intervals, AgreeWithPointsAskedOneByOne) {
  const Random random(5, stream_id("test.intervals"));
  for (std::uint32_t round = 0; round < 200; ++round) {
    Intervals kept, taken;
    for (std::uint64_t i = 0; i < 5; ++i) {
      const double from = 20.0 * static_cast<double>(i);
      kept.push_back({from, from + random.uniform(round, i, 1.0, 20.0)});
    }
    for (std::uint64_t i = 0; i < 12; ++i) {
      const double from = random.uniform(round, 100 + i, -5.0, 100.0);
      taken.push_back({from, from + random.uniform(round, 200 + i, -2.0, 15.0)});
    }
    const Intervals left = without(kept, taken);
    const auto is_in = [](const Intervals& all, double at) {
      return std::any_of(all.begin(), all.end(),
                         [&](const Interval& one) { return one.from < at && at < one.to; });
    };
    for (std::uint64_t i = 0; i < 500; ++i) {
      const double at = random.uniform(round, 1000 + i, -5.0, 110.0);
      ASSERT_EQ(is_in(left, at), is_in(kept, at) && !is_in(taken, at)) << round << " " << at;
    }
    for (std::size_t i = 0; i + 1 < left.size(); ++i) ASSERT_LT(left[i].to, left[i + 1].from);
  }
}

TEST(KeepWherePositive, CutsAtTheRoot) {
  const auto kept = [](double at_zero, double slope) {
    Interval interval{0, 10};
    keep_where_positive(interval, at_zero, slope);
    return interval;
  };
  EXPECT_TRUE(kept(-4, 2) == (Interval{2, 10}));
  EXPECT_TRUE(kept(4, -2) == (Interval{0, 2}));
  EXPECT_TRUE(kept(1, 0) == (Interval{0, 10}));
  EXPECT_FALSE(kept(-1, 0).from < kept(-1, 0).to);
  EXPECT_FALSE(kept(-30, 2).from < kept(-30, 2).to);
}

}  // namespace
}  // namespace hallway
