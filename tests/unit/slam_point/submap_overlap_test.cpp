// SPDX-License-Identifier: MIT
// Grouping: which submap a frame belongs to.
#include "slam_point/core/submaps/submap_overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "scenes.hpp"

namespace hallway::slam_point {
namespace {

using Landmarks = std::vector<Index>;

/// Landmarks, and submaps of which each knows some, and saw some of these with its first frame.
class Submaps {
 public:
  explicit Submaps(Index landmarks) {
    for (Index l = 0; l < landmarks; ++l) graph.add_landmark(Vec3(2.0 * l, 0, 0), 0);
  }
  Index add(const Landmarks& first, const Landmarks& later = {}) {
    const Index submap = graph.add_submap(Pose{});
    for (const Index l : first) join(submap, l, true);
    for (const Index l : later) join(submap, l, false);
    firsts.emplace_back(first.begin(), first.end());
    return submap;
  }
  double with_active(Index submap, const Landmarks& frame) {
    graph.activate(submap);
    const double shared = SubmapOverlap::with_active(graph, seen(frame));
    graph.deactivate();
    return shared;
  }
  Index best(const Landmarks& frame, double least) { return overlap.best(graph, seen(frame), least); }

  /// Slow and obvious: landmarks that both saw over those that either saw.
  double by_sets(Index submap, const Landmarks& frame) const {
    std::set<Index> either = firsts[submap];
    std::size_t both = 0;
    for (const Index l : frame) {
      both += firsts[submap].count(l);
      either.insert(l);
    }
    return static_cast<double>(both) / static_cast<double>(either.size());
  }
  Index best_by_sets(const Landmarks& frame, double least) const {
    Index best = kNone;
    for (Index submap = 0; submap < firsts.size(); ++submap) {
      const double shared = by_sets(submap, frame);
      if (shared >= least && (best == kNone || shared > by_sets(best, frame))) best = submap;
    }
    return best;
  }

  SubmapGraph graph{1.0};
  std::vector<std::set<Index>> firsts{};
  SubmapOverlap overlap{};

 private:
  void join(Index submap, Index landmark, bool first) {
    const Index member = graph.join(submap, landmark, graph.landmarks[landmark].position, first);
    graph.submaps[submap].members[member].count = 1;
    graph.resum(landmark);
  }
  /// A frame of these landmarks, and of a point that is none.
  static Observations seen(const Landmarks& landmarks) {
    Observations frame{{Vec3::Zero(), 0}};
    for (const Index l : landmarks) frame.push_back({Vec3::Zero(), frame.size(), l});
    return frame;
  }
};

TEST(SubmapOverlap, ByHand) {
  Submaps submaps(12);
  submaps.add({0, 1, 2, 3}, {4, 5, 6});
  EXPECT_EQ(submaps.with_active(0, {0, 1, 2, 3}), 1.0);
  EXPECT_EQ(submaps.with_active(0, {1, 2, 3}), 0.75);
  EXPECT_EQ(submaps.with_active(0, {2, 3, 4, 5}), 2.0 / 6.0) << "4 and 5 came later";
  EXPECT_EQ(submaps.with_active(0, {0, 1, 2, 3, 8, 9, 10, 11}), 0.5);
  EXPECT_EQ(submaps.with_active(0, {8, 9}), 0.0);
  EXPECT_EQ(submaps.with_active(0, {}), 0.0);
}

TEST(SubmapOverlap, TheBestIsTheLargestOfAtLeastSoMuchAndTheOldestOfEqualOnes) {
  Submaps submaps(12);
  submaps.add({8, 9, 10, 11});
  submaps.add({2, 3, 4, 5});
  submaps.add({1, 2, 3, 4});
  submaps.add({4, 3, 2, 1});
  submaps.add({6, 7}, {1, 2, 3, 4});
  EXPECT_EQ(submaps.best({1, 2, 3, 4}, 0.5), 2u);
  EXPECT_EQ(submaps.best({2, 3, 4, 5}, 0.5), 1u);
  EXPECT_EQ(submaps.best({3, 4, 5, 6}, 0.6), 1u) << "3 of 5";
  EXPECT_EQ(submaps.best({3, 4, 5, 6}, 0.61), kNone);
  EXPECT_EQ(submaps.best({}, 0.0), kNone);
  EXPECT_EQ(submaps.best({0}, 0.0), kNone);
}

TEST(SubmapOverlap, IsWhatComparingAllSetsGives) {
  scenes::Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    constexpr Index kLandmarks = 30;
    Submaps submaps(kLandmarks);
    const auto some = [&](double share) {
      Landmarks chosen;
      for (Index l = 0; l < kLandmarks; ++l) {
        if (random.uniform(0.0, 1.0) < share) chosen.push_back(l);
      }
      return chosen;
    };
    for (int s = 0; s < 12; ++s) {
      const Landmarks first = some(0.4);
      Landmarks later;
      for (const Index l : some(0.3)) {
        if (std::find(first.begin(), first.end(), l) == first.end()) later.push_back(l);
      }
      submaps.add(first, later);
    }
    for (int f = 0; f < 5; ++f) {
      const Landmarks frame = some(0.4);
      const double least = random.uniform(0.1, 0.5);
      EXPECT_EQ(submaps.best(frame, least), submaps.best_by_sets(frame, least));
      for (Index s = 0; s < 12; ++s) EXPECT_EQ(submaps.with_active(s, frame), submaps.by_sets(s, frame));
    }
  }
}

TEST(SubmapOverlap, IsTheSameWhateverTheOrderOfPoints) {
  Submaps submaps(9);
  submaps.add({0, 1, 2, 3, 4});
  submaps.add({1, 2, 3, 4, 5});
  submaps.add({0, 2, 3, 4, 5});
  Landmarks frame{0, 1, 2, 3, 4, 5};
  do {
    ASSERT_EQ(submaps.best(frame, 0.5), 0u);
  } while (std::next_permutation(frame.begin(), frame.end()));
}

}  // namespace
}  // namespace hallway::slam_point
