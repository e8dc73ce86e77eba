// SPDX-License-Identifier: MIT
#include "slam_point/core/thesis/matcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point::thesis {
namespace {

/// Nearest pair first among all pairs, by looking at all of them again and again: the oracle. Landmarks that are not `usable` have none.
std::vector<Index> of_all_pairs(const std::vector<Vec3>& points, const std::vector<Vec3>& landmarks,
                                std::vector<bool> usable, double bound) {
  std::vector<Index> match(points.size(), kNone);
  for (;;) {
    double best = std::numeric_limits<double>::infinity();
    std::size_t point = 0;
    std::size_t landmark = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      for (std::size_t l = 0; l < landmarks.size(); ++l) {
        const double d = (points[p] - landmarks[l]).norm();
        if (match[p] != kNone || !usable[l] || d > bound || d >= best) continue;
        best = d;
        point = p;
        landmark = l;
      }
    }
    if (best > bound) return match;
    match[point] = static_cast<Index>(landmark);
    usable[landmark] = false;
  }
}

std::vector<Observation> frame_of(const std::vector<Vec3>& points) {
  std::vector<Observation> frame;
  for (const Vec3& p : points) frame.push_back({p, frame.size()});
  return frame;
}

std::vector<Index> landmarks_of(const std::vector<Observation>& frame) {
  std::vector<Index> landmarks;
  for (const Observation& observation : frame) landmarks.push_back(observation.landmark);
  return landmarks;
}

/// Tracks, and a matcher with bounds of 0.6 m from frame to frame and 0.8 m in the map.
struct Followed {
  explicit Followed(Matching kind = Matching::nearest) { options.matching = static_cast<int>(kind); }
  Index add(const Vec3& point) {
    const Index track = tracks.add(point);
    tracks.see(track, point);
    return track;
  }
  std::vector<Index> recent(Iteration now, const std::vector<Vec3>& points, const Pose& moved = {}) {
    std::vector<Observation> frame = frame_of(points);
    Matcher(common, options).match_recent(tracks, now, moved, frame);
    return landmarks_of(frame);
  }
  slam_point::Options common{};
  Options options{};
  Tracks tracks{20, 0.8};
};

TEST(ThesisMatcher, TheNearestPairIsTakenFirstByHand) {
  Followed two;
  two.tracks.begin_iteration(4);
  two.add(Vec3(0, 0, 0));
  two.add(Vec3(0.5, 0, 0));
  // Both points are nearest to the first landmark; the nearer one gets it, and the other the second. A third is too far from both.
  EXPECT_EQ(two.recent(5, {{0.2, 0, 0}, {0.1, 0, 0}, {-0.61, 0, 0}}), (std::vector<Index>{1, 0, kNone}));
  EXPECT_EQ(two.recent(5, {{-0.59, 0, 0}}), std::vector<Index>{0});
}

TEST(ThesisMatcher, LandmarksAreFollowedOverSoManyIterationsByHand) {
  Followed two;
  two.options.match_iterations = 3;
  two.tracks.begin_iteration(4);
  two.add(Vec3(0, 0, 0));
  two.tracks.begin_iteration(5);
  two.add(Vec3(2, 0, 0));
  two.tracks.begin_iteration(7);
  const std::vector<Vec3> seen{{0.1, 0, 0}, {2.1, 0, 0}};
  EXPECT_EQ(two.recent(7, seen), (std::vector<Index>{0, 1}));
  EXPECT_EQ(two.recent(8, seen), (std::vector<Index>{kNone, 1}));
  EXPECT_EQ(two.recent(9, seen), (std::vector<Index>{kNone, kNone}));
}

TEST(ThesisMatcher, WithPredictionPointsAreMovedOnceForEachIterationByHand) {
  Followed one(Matching::predicted);
  one.tracks.begin_iteration(4);
  one.add(Vec3(9, 0, 0));
  one.tracks.begin_iteration(5);
  // The sensor goes one metre ahead in each iteration: the point comes nearer.
  const Pose moved{Eigen::Quaterniond::Identity(), Vec3(1, 0, 0)};
  EXPECT_EQ(one.recent(5, {{8.1, 0, 0}}, moved), std::vector<Index>{0});
  EXPECT_EQ(one.recent(6, {{7.1, 0, 0}}, moved), std::vector<Index>{0});
  EXPECT_EQ(one.recent(6, {{8.1, 0, 0}}, moved), std::vector<Index>{kNone});
  one.options.matching = static_cast<int>(Matching::nearest);
  EXPECT_EQ(one.recent(6, {{8.9, 0, 0}}, moved), std::vector<Index>{0}) << "as it was seen";
}

TEST(ThesisMatcher, AfterTheMotionIsFittedItsErrorIsNoReasonForAWrongMatch) {
  // Points 0.5 m apart, half of them a column beside, that turned out to have moved 0.3 m more than predicted.
  Followed many(Matching::predicted);
  many.tracks.begin_iteration(4);
  std::vector<Vec3> seen;
  scenes::Random random(1);
  for (int i = 0; i < 30; ++i) {
    const Vec3 p(random.uniform(0, 20), random.uniform(0, 20), random.uniform(0, 6));
    many.add(p);
    seen.push_back(p + Vec3(0.3, 0, 0));
  }
  // One that is no more there, and another one 0.2 m from where it was.
  many.add(Vec3(30, 0, 0));
  seen.push_back(Vec3(29.8, 0, 0));
  std::vector<Index> expected;
  for (Index l = 0; l < 30; ++l) expected.push_back(l);
  expected.push_back(kNone);  // 0.5 m from it after the fit, more than eight times the noise
  EXPECT_EQ(many.recent(5, seen), expected);
}

TEST(ThesisMatcher, MatchesAsLookingAtAllPairsDoes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    scenes::Random random(seed);
    const auto place = [&] { return Vec3(random.uniform(0, 8), random.uniform(0, 8), random.uniform(0, 2)); };
    Followed many;
    std::vector<Vec3> newest;
    for (Iteration i = 4; i < 7; ++i) {
      many.tracks.begin_iteration(i);
      for (Index l = 0; l < newest.size(); ++l) {
        if (random.uniform(0, 1) < 0.5) many.tracks.see(l, newest[l] = newest[l] + 0.1 * place());
      }
      for (int more = 0; more < 40; ++more) {
        newest.push_back(place());
        many.add(newest.back());
      }
    }
    std::vector<Vec3> points;
    for (int i = 0; i < 100; ++i) points.push_back(place());
    EXPECT_EQ(many.recent(7, points),
              of_all_pairs(points, newest, std::vector<bool>(newest.size(), true), 0.6));
  }
}

TEST(ThesisMatcher, InTheMapMatchesAsLookingAtAllPairsDoes) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    scenes::Random random(seed);
    const auto place = [&] { return Vec3(random.uniform(0, 8), random.uniform(0, 8), random.uniform(0, 2)); };
    Followed many;
    many.tracks.begin_iteration(4);
    std::vector<Vec3> landmarks;
    std::vector<bool> usable;
    for (Index l = 0; l < 120; ++l) {
      landmarks.push_back(place());
      many.add(landmarks.back());
      many.tracks[l].level = l % 3 == 0 ? 0 : 2;  // each third has no group yet
      usable.push_back(l % 3 != 0);
    }
    const Pose T{rotation_exp(Vec3(0.1, 0.2, -1.0)), Vec3(4, -3, 1)};
    std::vector<Vec3> points;
    std::vector<Vec3> in_map;
    for (int i = 0; i < 100; ++i) {
      in_map.push_back(place());
      points.push_back(T.inverse() * in_map.back());
    }
    std::vector<Observation> frame = frame_of(points);
    frame[0].landmark = 1;  // matched before, and so is its landmark
    usable[1] = false;
    in_map[0] = Vec3(100, 0, 0);
    Matcher(many.common, many.options).match_map(many.tracks, T, frame);
    std::vector<Index> expected = of_all_pairs(in_map, landmarks, usable, 0.8);
    expected[0] = 1;
    EXPECT_EQ(landmarks_of(frame), expected);
  }
}

TEST(ThesisMatcher, NeitherTheOrderOfPointsNorWhatWasMatchedBeforeMatters) {
  scenes::Random random(3);
  const auto place = [&] { return Vec3(random.uniform(0, 8), random.uniform(0, 8), random.uniform(0, 2)); };
  Followed many;
  many.tracks.begin_iteration(4);
  for (int i = 0; i < 100; ++i) many.add(place());
  std::vector<Vec3> points;
  for (int i = 0; i < 80; ++i) points.push_back(place());
  std::vector<Index> expected = many.recent(5, points);
  Matcher used(many.common, many.options);
  for (int again = 0; again < 3; ++again) {
    std::vector<Observation> frame = frame_of(points);
    used.match_recent(many.tracks, 5, Pose{}, frame);
    EXPECT_EQ(landmarks_of(frame), expected);
    std::reverse(points.begin(), points.end());
    std::reverse(expected.begin(), expected.end());
  }
  // Later, when half of the landmarks have not been seen again.
  many.tracks.begin_iteration(7);
  for (Index l = 0; l < 50; ++l) many.tracks.see(l, place());
  std::vector<Observation> frame = frame_of(points);
  used.match_recent(many.tracks, 8, Pose{}, frame);
  EXPECT_EQ(landmarks_of(frame), many.recent(8, points));
}

}  // namespace
}  // namespace hallway::slam_point::thesis
