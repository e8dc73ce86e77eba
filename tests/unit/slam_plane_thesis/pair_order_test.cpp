// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/pair_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.hpp"
#include "unit/slam_plane_thesis/walls.hpp"

namespace hallway::slam_plane::thesis::test {
namespace {

using Matrix = std::vector<std::vector<double>>;

/// Sum of a greatest spanning tree, by Prim's algorithm on the complete graph.
double prim(const Matrix& weights) {
  const std::size_t n = weights.size();
  std::vector<double> best(weights[0]);
  std::vector<bool> in(n, false);
  in[0] = true;
  double total = 0.0;
  for (std::size_t i = 1; i < n; ++i) {
    std::size_t next = 0;
    for (std::size_t j = 1; j < n; ++j) {
      if (!in[j] && (next == 0 || best[j] > best[next])) next = j;
    }
    in[next] = true;
    total += best[next];
    for (std::size_t j = 1; j < n; ++j) best[j] = std::max(best[j], weights[next][j]);
  }
  return total;
}

double sum_of(const std::vector<PairEdge>& edges, const Matrix& weights) {
  double total = 0.0;
  for (const PairEdge& edge : edges)
    total += weights[static_cast<std::size_t>(edge.parent)][static_cast<std::size_t>(edge.child)];
  return total;
}

/// Each edge's parent is member 0 or the child of an earlier edge, and nobody is a child twice.
void expect_tree(const std::vector<PairEdge>& edges, int n) {
  std::vector<bool> placed(static_cast<std::size_t>(n), false);
  placed[0] = true;
  for (const PairEdge& edge : edges) {
    EXPECT_TRUE(placed[static_cast<std::size_t>(edge.parent)]);
    EXPECT_FALSE(placed[static_cast<std::size_t>(edge.child)]);
    placed[static_cast<std::size_t>(edge.child)] = true;
  }
}

Matrix overlaps(const std::vector<Interval>& visible) {
  Matrix weights(visible.size(), std::vector<double>(visible.size(), 0.0));
  for (std::size_t i = 0; i < visible.size(); ++i) {
    for (std::size_t j = 0; j < visible.size(); ++j)
      weights[i][j] = static_cast<double>(intersection(visible[i], visible[j]).size());
  }
  return weights;
}

/// Intervals that all contain iteration 100, as those of a submap do.
std::vector<Interval> random_visible(std::uint64_t seed, int n) {
  const Random random(seed, stream_id("pair_order_test"));
  std::vector<Interval> visible;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i)
    visible.push_back({static_cast<Iteration>(random.uniform(i, 0, 0.0, 100.0)),
                       static_cast<Iteration>(random.uniform(i, 1, 100.0, 400.0))});
  return visible;
}

TEST(PairOrder, SpanningTreeIsAGreatestOne) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Random random(seed, stream_id("pair_order_test.weights"));
    const int n = 2 + static_cast<int>(random.uniform(0, 0, 0.0, 30.0));
    Matrix weights(static_cast<std::size_t>(n), std::vector<double>(static_cast<std::size_t>(n), 0.0));
    for (std::size_t i = 0; i < weights.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j)
        weights[i][j] = weights[j][i] = std::floor(random.uniform(1, 100 * i + j, 1.0, 50.0));
    }
    int asked = 0;
    const auto weight = [&](int a, int b) {
      ++asked;
      return weights[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
    };
    const auto loose = [&](int a, int b) {
      const double w = weights[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
      return w + random.uniform(2, static_cast<std::uint64_t>(100 * a + b), 0.0, 5.0);
    };
    const auto edges = maximum_spanning_tree(n, loose, weight);
    ASSERT_EQ(static_cast<int>(edges.size()), n - 1);
    expect_tree(edges, n);
    EXPECT_EQ(sum_of(edges, weights), prim(weights));
    EXPECT_LE(asked, n * (n - 1) / 2);
  }
}

TEST(PairOrder, BoundsSpareComparisons) {
  const std::vector<Interval> visible = random_visible(7, 30);
  const Matrix weights = overlaps(visible);
  int asked = 0;
  const auto bound = [&](int a, int b) {
    return weights[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  };
  maximum_spanning_tree(30, bound, [&](int a, int b) {
    ++asked;
    return bound(a, b);
  });
  EXPECT_LT(asked, 60);  // of 435
}

TEST(PairOrder, MembersThatNothingConnectsAreLeftOut) {
  const auto weight = [](int a, int b) { return a / 2 == b / 2 ? 10.0 : 0.0; };
  EXPECT_EQ(maximum_spanning_tree(4, weight, weight), (std::vector<PairEdge>{{0, 1}}));
  EXPECT_TRUE(maximum_spanning_tree(0, weight, weight).empty());
  EXPECT_TRUE(maximum_spanning_tree(1, weight, weight).empty());
}

TEST(PairOrder, SortedIntervalsGiveAGreatestTree) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const int n = 2 + static_cast<int>(seed % 40);
    const std::vector<Interval> visible = random_visible(seed, n);
    const auto edges = interval_spanning_tree(visible);
    ASSERT_EQ(static_cast<int>(edges.size()), n - 1);
    expect_tree(edges, n);
    EXPECT_EQ(sum_of(edges, overlaps(visible)), prim(overlaps(visible)));
  }
}

TEST(PairOrder, TotalIntervalIsThatOfPrimsTreeOfAllPairs) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Segment walls[] = {kAlong, kAhead, kSlanted, kFacing};
    const std::vector<Interval> visible = random_visible(seed, 8);
    std::vector<Track> tracks;
    for (std::size_t i = 0; i < visible.size(); ++i) {
      const auto cut = [&](Iteration k) {
        const double phase = 0.03 * static_cast<double>(k) + static_cast<double>(i);
        return i % 3 == 0 ? Hidden{} : Hidden{1.0 + std::sin(phase), 0.0};
      };
      tracks.push_back(track_of(i, walls[i % 4], visible[i], curved, cut));
    }
    std::vector<const Track*> members;
    for (const Track& track : tracks) members.push_back(&track);
    PairComparer comparer{CompareOptions{}};
    Matrix shared(8, std::vector<double>(8, 0.0));
    for (std::size_t i = 0; i < 8; ++i) {
      for (std::size_t j = 0; j < 8; ++j) {
        const Comparison comparison = i == j ? Comparison{} : comparer.compare(tracks[i], tracks[j]);
        shared[i][j] = comparison.has_keys() ? comparison.shared : 0.0;
      }
    }
    const auto edges = order_comparisons(comparer, members);
    expect_tree(edges, 8);
    EXPECT_GE(sum_of(edges, shared), 0.95 * prim(shared));
  }
}

TEST(PairOrder, PairsThatAreNotParallelArePreferred) {
  // 2 was seen with 0, which is parallel to it, as long as with 1.
  const Track along = track_of(0, kAlong, {0, 100}, straight),
              ahead = track_of(1, kAhead, {0, 100}, straight);
  const Track facing = track_of(2, kFacing, {0, 100}, straight);
  PairComparer comparer{CompareOptions{}};
  const std::vector<const Track*> members{&along, &ahead, &facing};
  EXPECT_EQ(order_comparisons(comparer, members), (std::vector<PairEdge>{{0, 1}, {1, 2}}));
}

TEST(PairOrder, AnyTreeGivesTheSameMapWhereAllIsVisibleAtATime) {
  // Noise across the walls; directions and lengths are exact, so nothing but the order of pairs could make a difference.
  const Random random(2, stream_id("pair_order_test.any_tree"));
  const Segment walls[] = {kAlong, kAhead, kSlanted, kFacing};
  std::vector<Track> tracks;
  for (TrackId id = 0; id < 4; ++id) {
    tracks.emplace_back(id, TrackOptions{});
    for (Iteration k = 0; k < 80; ++k) {
      const Vec2 off = 0.02 * random.normal(static_cast<std::uint32_t>(k), id) * walls[id].normal();
      const Segment moved{{walls[id].end[0] + off, walls[id].end[1] + off}};
      tracks.back().push(seen(moved, curved(k), k));
    }
  }
  std::vector<const Track*> members;
  for (const Track& track : tracks) members.push_back(&track);
  PairComparer comparer{CompareOptions{}};
  const auto star = place_members(comparer, members, std::vector<PairEdge>{{0, 1}, {0, 2}, {0, 3}});
  for (const auto& edges :
       {std::vector<PairEdge>{{0, 1}, {1, 2}, {2, 3}}, std::vector<PairEdge>{{0, 3}, {3, 2}, {2, 1}},
        order_comparisons(comparer, members)}) {
    const auto placements = place_members(comparer, members, edges);
    for (std::size_t i = 1; i < 4; ++i) {
      EXPECT_LT((placements[i].middle - star[i].middle).norm(), 1e-9);
      EXPECT_LT((placements[i].direction - star[i].direction).norm(), 1e-9);
    }
  }
}

TEST(PairOrder, PairsWithoutKeyPointsConnectWhatNothingElseDoes) {
  const Segment behind{{Vec2(-1, 3), Vec2(7, 3)}};
  const auto grow = [](Iteration k) { return Hidden{0.0, 3.0 - 0.05 * static_cast<double>(k)}; };
  const Track a = track_of(0, kAlong, {0, 50}, straight, grow),
              b = track_of(1, behind, {0, 50}, straight, grow);
  PairComparer comparer{CompareOptions{}};
  const std::vector<const Track*> members{&a, &b};
  const auto edges = order_comparisons(comparer, members);
  ASSERT_EQ(edges.size(), 1u);
  const auto placements = place_members(comparer, members, edges);
  EXPECT_TRUE(placements[0].valid && placements[1].valid);
  EXPECT_EQ(placements[1].key, KeyPoint::none);
}

}  // namespace
}  // namespace hallway::slam_plane::thesis::test
