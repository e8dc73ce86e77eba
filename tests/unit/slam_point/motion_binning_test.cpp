// SPDX-License-Identifier: MIT
#include "slam_point/core/moving/motion_binning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "scenes.hpp"

namespace hallway::slam_point {
namespace {

/// Points in a space of their own kind: those of one label are rigid against each other, all others are not.
struct Labelled {
  std::vector<int> labels;  // negative ones are alone
  scenes::Random random{1};

  double deviation(std::uint32_t a, std::uint32_t b) {
    const bool rigid = a == b || (labels[a] == labels[b] && labels[a] >= 0);
    return rigid ? random.uniform(0.04, 0.06) : random.uniform(0.3, 2.0);
  }
};

Labelled shares(std::size_t points, const std::vector<double>& groups, std::uint64_t seed) {
  Labelled made;
  scenes::Random random(seed);
  for (std::size_t p = 0; p < points; ++p) {
    double drawn = random.uniform(0.0, 1.0);
    int label = -1;
    for (std::size_t g = 0; g < groups.size() && label < 0; ++g) {
      if (drawn < groups[g]) label = static_cast<int>(g);
      drawn -= groups[g];
    }
    made.labels.push_back(label);
  }
  made.random = scenes::Random(seed + 1000);
  return made;
}

BinningResult binned(Labelled& points, const BinningRules& rules = {}) {
  return bin_points(points.labels.size(), rules,
                    [&](std::uint32_t a, std::uint32_t b) { return points.deviation(a, b); });
}

/// Slow and obvious: the connected components of all pairs within the threshold.
std::vector<std::uint32_t> components(Labelled points, double threshold_m) {
  std::vector<std::uint32_t> bin(points.labels.size());
  std::iota(bin.begin(), bin.end(), 0u);
  for (std::uint32_t a = 0; a < bin.size(); ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      if (points.deviation(a, b) > threshold_m || bin[a] == bin[b]) continue;
      const std::uint32_t from = std::max(bin[a], bin[b]);
      const std::uint32_t into = std::min(bin[a], bin[b]);
      std::replace(bin.begin(), bin.end(), from, into);
    }
  }
  return bin;
}

TEST(MotionBinning, NothingThatMovesIsOneBinByThePossibleLeast) {
  Labelled points = shares(40, {1.0}, 1);
  BinningRules rules;
  rules.enough_share = 1.0;
  const BinningResult result = binned(points, rules);
  EXPECT_EQ(std::set<std::uint32_t>(result.bin_of.begin(), result.bin_of.end()).size(), 1u);
  EXPECT_EQ(result.comparisons, 39u);
}

TEST(MotionBinning, ByHand) {
  // 0, 2 and 3 keep their distances, 1 and 4 go ways of their own.
  Labelled points{{0, -1, 0, 0, -1}};
  const BinningResult result = binned(points);
  EXPECT_EQ(result.bin_of, (std::vector<std::uint32_t>{0, 1, 0, 0, 4}));
  EXPECT_TRUE(result.stands(0) && result.stands(2) && result.stands(3));
  EXPECT_FALSE(result.stands(1) || result.stands(4));
}

TEST(MotionBinning, OfEqualBinsTheOneWithTheLowestPointStands) {
  Labelled points{{1, 0, 0, 1, -1}};
  BinningRules rules;
  rules.threshold_m = 0.1;
  const BinningResult result = binned(points, rules);
  EXPECT_EQ(result.bin_of, (std::vector<std::uint32_t>{0, 1, 1, 0, 4}));
  EXPECT_EQ(result.largest, 0u);
}

TEST(MotionBinning, NoTwoBinsAreComparedTwice) {
  constexpr double kThreshold_m = 0.1;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Labelled points = shares(60, {0.4, 0.2, 0.1}, seed);
    BinningRules rules;
    rules.threshold_m = kThreshold_m;
    std::vector<std::uint32_t> bin(points.labels.size());
    std::iota(bin.begin(), bin.end(), 0u);
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        apart;  // points of different bins that were compared
    int again = 0;
    bin_points(bin.size(), rules, [&](std::uint32_t a, std::uint32_t b) {
      const std::set<std::uint32_t> now{bin[a], bin[b]};
      for (const auto& [x, y] : apart) again += now == std::set<std::uint32_t>{bin[x], bin[y]} ? 1 : 0;
      EXPECT_EQ(now.size(), 2u) << "they are in one bin";
      const double deviation_m = points.deviation(a, b);
      if (deviation_m > kThreshold_m) {
        apart.emplace_back(a, b);
      } else {
        std::replace(bin.begin(), bin.end(), *now.rbegin(), *now.begin());
      }
      return deviation_m;
    });
    EXPECT_EQ(again, 0) << "seed " << seed;
  }
}

TEST(MotionBinning, FewOrNoPoints) {
  for (const std::size_t n : {0u, 1u, 2u}) {
    Labelled points = shares(n, {1.0}, 3);
    const BinningResult result = binned(points);
    ASSERT_EQ(result.bin_of.size(), n);
    for (std::size_t p = 0; p < n; ++p) EXPECT_TRUE(result.stands(p));
  }
}

TEST(MotionBinning, TheThresholdLiesWhereTheDeviationsJump) {
  Labelled points = shares(200, {0.8}, 4);
  const BinningResult result = binned(points);
  EXPECT_GE(result.threshold_m, 0.06);
  EXPECT_LE(result.threshold_m, 0.3);
  BinningRules lowest;
  lowest.gap_place = 0.0;
  Labelled same = shares(200, {0.8}, 4);
  EXPECT_LE(binned(same, lowest).threshold_m, 0.06);
  BinningRules given;
  given.threshold_m = 0.1;
  Labelled again = shares(200, {0.8}, 4);
  EXPECT_EQ(binned(again, given).threshold_m, 0.1);
}

TEST(MotionBinning, FindsTheBinsOfAllPairs) {
  const std::vector<std::vector<double>> mixtures{
      {1.0}, {0.9}, {0.7}, {0.6}, {0.5, 0.1, 0.1, 0.1, 0.1}, {0.4, 0.35}, {0.2, 0.2}};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const std::vector<double>& mixture : mixtures) {
      for (const bool priority : {true, false}) {
        BinningRules rules;
        rules.priority = priority;
        rules.threshold_m = 0.1;
        rules.enough_share = 1.0;  // all bins are wanted
        Labelled points = shares(60, mixture, seed);
        const std::vector<std::uint32_t> wanted = components(points, 0.1);
        const BinningResult result = binned(points, rules);
        EXPECT_EQ(result.bin_of, wanted) << "seed " << seed;
        EXPECT_LE(result.comparisons, 60u * 59u / 2u);
      }
    }
  }
}

TEST(MotionBinning, StoppingWithEnoughLeavesTheSameLargestBin) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Labelled points = shares(80, {0.6, 0.2}, seed);
    const std::vector<std::uint32_t> wanted = components(points, 0.1);
    BinningRules rules;
    rules.threshold_m = 0.1;
    const BinningResult result = binned(points, rules);
    for (std::uint32_t p = 0; p < 80; ++p)
      EXPECT_EQ(result.stands(p), wanted[p] == result.largest) << "seed " << seed << " point " << p;
  }
}

/// Figure 115: with the priority heuristic about n log n comparisons up to 40 % of noise, and fewer than without.
TEST(MotionBinning, PriorityKeepsComparisonsNearNLogN) {
  for (const std::size_t n : {60u, 200u, 400u}) {
    for (const double noise : {0.0, 0.1, 0.2, 0.3, 0.4}) {
      std::uint64_t with = 0;
      std::uint64_t without = 0;
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        BinningRules rules;
        Labelled points = shares(n, {1.0 - noise}, seed);
        with += binned(points, rules).comparisons;
        rules.priority = false;
        Labelled again = shares(n, {1.0 - noise}, seed);
        without += binned(again, rules).comparisons;
      }
      const double size = static_cast<double>(n);
      EXPECT_LE(static_cast<double>(with) / 5.0, 1.2 * size * std::log2(size)) << n << " points, " << noise;
      if (noise >= 0.2) {
        EXPECT_LT(with, without) << n << " points, " << noise;
      }
    }
  }
}

TEST(MotionBinning, DeviationOfADistanceDoesNotSeeHowTheSensorMoves) {
  scenes::Random random(7);
  std::vector<Vec3> a;
  std::vector<Vec3> b;
  std::vector<Vec3> walker;
  for (int f = 0; f < 50; ++f) {
    const Pose T = scenes::heading(Vec3(0.1 * f, 0.0, 0.0), 0.02 * f).inverse();
    a.push_back(T * Vec3(5, 1, 0));
    b.push_back(T * Vec3(8, -2, 1));
    walker.push_back(T * Vec3(8 + 0.1 * f, 2, 0));
  }
  EXPECT_LT(distance_deviation(a, b), 1e-12);
  EXPECT_GT(distance_deviation(a, walker), 0.5);
  EXPECT_EQ(distance_deviation({Vec3::Zero()}, {Vec3::UnitX()}), 0.0);
}

TEST(MotionBinning, SamePointsSameBins) {
  Labelled points = shares(150, {0.6, 0.1}, 9);
  Labelled again = shares(150, {0.6, 0.1}, 9);
  const BinningResult one = binned(points);
  const BinningResult two = binned(again);
  EXPECT_EQ(one.bin_of, two.bin_of);
  EXPECT_EQ(one.comparisons, two.comparisons);
}

}  // namespace
}  // namespace hallway::slam_point
