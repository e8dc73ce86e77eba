// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/frame_matcher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

/// Nearest pair first among all pairs: the oracle.
std::vector<Index> nearest_first(const std::vector<Vec3>& points, const std::vector<Vec3>& landmarks,
                                 double bound) {
  std::vector<Index> match(points.size(), kNone);
  std::vector<bool> taken(landmarks.size(), false);
  for (;;) {
    double best = bound;
    std::size_t point = points.size();
    std::size_t landmark = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (match[p] != kNone) continue;
      for (std::size_t l = 0; l < landmarks.size(); ++l) {
        const double d = (points[p] - landmarks[l]).norm();
        if (!taken[l] && d <= best) {
          best = d;
          point = p;
          landmark = l;
        }
      }
    }
    if (point == points.size()) return match;
    match[point] = static_cast<Index>(landmark);
    taken[landmark] = true;
  }
}

TEST(FrameMatcher, MatchesAsLookingAtAllPairsDoes) {
  Options options;
  options.noise_m = 0.05;  // map bound 0.8 m
  scenes::Random random(1);
  const auto place = [&] { return Vec3(random.uniform(0, 8), random.uniform(0, 8), random.uniform(0, 2)); };
  SubmapGraph graph(options.map_bound());
  std::vector<Vec3> landmarks;
  for (int i = 0; i < 150; ++i) {
    landmarks.push_back(place());
    graph.add_landmark(landmarks.back(), 0);
  }
  FrameMatcher matcher(options, graph);
  std::vector<Vec3> points;
  std::vector<Observation> frame;
  for (std::size_t i = 0; i < 120; ++i) {
    points.push_back(place());
    frame.push_back({points.back(), i, kNone});
  }
  matcher.mark(frame);
  // "Local since activation 1" makes all of them old: the map bound holds.
  matcher.match_map(Pose{}, 1, 0.1, frame);
  const std::vector<Index> expected = nearest_first(points, landmarks, options.map_bound());
  for (std::size_t i = 0; i < frame.size(); ++i) EXPECT_EQ(frame[i].landmark, expected[i]) << "point " << i;
}

TEST(FrameMatcher, TheNearestPairIsTakenFirstByHand) {
  const Options options;  // map bound 0.8 m
  SubmapGraph graph(options.map_bound());
  graph.add_landmark(Vec3(0, 0, 0), 0);
  graph.add_landmark(Vec3(0.5, 0, 0), 0);
  FrameMatcher matcher(options, graph);
  // Both of the first points are nearest to landmark 0; the nearer one gets it, the other landmark 1. The third is too far off.
  std::vector<Observation> frame{{Vec3(0.2, 0, 0), 0}, {Vec3(0.1, 0, 0), 1}, {Vec3(-0.81, 0, 0), 2}};
  matcher.mark(frame);
  matcher.match_map(Pose{}, 1, 0.1, frame);
  EXPECT_EQ(frame[0].landmark, 1u);
  EXPECT_EQ(frame[1].landmark, 0u);
  EXPECT_EQ(frame[2].landmark, kNone);
}

TEST(FrameMatcher, NeitherTheOrderOfPointsNorWhatWasMatchedBeforeMatters) {
  const Options options;
  scenes::Random random(4);
  const auto place = [&] { return Vec3(random.uniform(0, 8), random.uniform(0, 8), random.uniform(0, 2)); };
  SubmapGraph graph(options.map_bound());
  for (int i = 0; i < 150; ++i) graph.add_landmark(place(), 0);
  std::vector<Observation> frame;
  for (std::size_t i = 0; i < 120; ++i) frame.push_back({place(), i});
  std::vector<Index> expected;
  FrameMatcher used(options, graph);
  for (int again = 0; again < 4; ++again) {
    for (Observation& observation : frame) observation.landmark = kNone;
    used.mark(frame);
    used.match_map(Pose{}, 1, 0.1, frame);
    std::vector<Index> match(frame.size());
    for (const Observation& observation : frame) match[observation.given] = observation.landmark;
    if (again == 0) expected = match;
    EXPECT_EQ(match, expected);
    std::rotate(frame.begin(), frame.begin() + 37, frame.end());
    std::reverse(frame.begin(), frame.begin() + 50);
  }
}

TEST(FrameMatcher, ALandmarkThatIsTakenIsNotTakenAgain) {
  const Options options;
  SubmapGraph graph(options.map_bound());
  graph.add_landmark(Vec3(0, 0, 0), 0);
  FrameMatcher matcher(options, graph);
  std::vector<Observation> frame{{Vec3(0.3, 0, 0), 0, 0}, {Vec3(0.1, 0, 0), 1}};
  matcher.mark(frame);
  EXPECT_TRUE(matcher.is_marked(0));
  matcher.match_map(Pose{}, 1, 0.1, frame);
  EXPECT_EQ(frame[0].landmark, 0u);
  EXPECT_EQ(frame[1].landmark, kNone);
}

TEST(FrameMatcher, BoundsWidenWithTheNoiseOfAPointAsFarAsTheGridReaches) {
  const Options options;  // reach 0.8 m
  SubmapGraph graph(options.map_bound());
  for (const double y : {0.0, 10.0, 20.0, 30.0}) graph.add_landmark(Vec3(0, y, 0), 5);
  FrameMatcher matcher(options, graph);
  // Of twice the noise: 0.3 m are 0.6 m. Of ten times the noise: 0.8 m and no more.
  std::vector<Observation> frame{
      {Vec3(0.55, 0, 0), 0}, {Vec3(0.65, 10, 0), 1}, {Vec3(0.75, 20, 0), 2}, {Vec3(0.85, 30, 0), 3}};
  frame[0].weight = frame[1].weight = 0.25;
  frame[2].weight = frame[3].weight = 0.01;
  matcher.mark(frame);
  matcher.match_map(Pose{}, 3, 0.3, frame);
  EXPECT_EQ(frame[0].landmark, 0u);
  EXPECT_EQ(frame[1].landmark, kNone);
  EXPECT_EQ(frame[2].landmark, 2u);
  EXPECT_EQ(frame[3].landmark, kNone);
}

TEST(FrameMatcher, LocalLandmarksAreMatchedWithinTheLocalBoundOnly) {
  const Options options;
  SubmapGraph graph(options.map_bound());
  graph.add_landmark(Vec3(0.0, 0.0, 0.0), 5);
  graph.add_landmark(Vec3(10.0, 0.0, 0.0), 1);
  FrameMatcher matcher(options, graph);
  std::vector<Observation> frame{{Vec3(0.5, 0.0, 0.0), 0, kNone}, {Vec3(10.5, 0.0, 0.0), 1, kNone}};
  matcher.mark(frame);
  matcher.match_map(Pose{}, 3, 0.3, frame);
  EXPECT_EQ(frame[0].landmark, kNone);
  EXPECT_EQ(frame[1].landmark, 1u);
}

/// Ten old landmarks in a row, and a frame that sees each `off[i]` metres beside its place, matched to them.
struct OldGround {
  explicit OldGround(const std::vector<double>& off) {
    for (std::size_t i = 0; i < off.size(); ++i) {
      const Vec3 place(static_cast<double>(2 * i), 0.0, 0.0);
      frame.push_back({place + Vec3(0.0, off[i], 0.0), i, graph.add_landmark(place, 0)});
    }
    matcher.mark(frame);
    matcher.drop_outliers(Pose{}, 1, frame);
  }
  Options options{};  // noise 0.05 m: up to 0.3 m is noise
  SubmapGraph graph{options.map_bound()};
  FrameMatcher matcher{options, graph};
  std::vector<Observation> frame{};
};

TEST(FrameMatcher, ANeighbourOfAnOldLandmarkIsNotTakenForIt) {
  const OldGround seen({0.0, 0.1, -0.1, 0.5});
  EXPECT_EQ(seen.frame[3].landmark, kNone);
  EXPECT_FALSE(seen.frame[3].withheld) << "it is a new landmark";
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NE(seen.frame[i].landmark, kNone) << i;
}

TEST(FrameMatcher, OldGroundThatHasDriftedAsAWholeIsStillKnown) {
  const OldGround seen({0.5, 0.5, 0.5, 0.5});
  for (const Observation& observation : seen.frame) EXPECT_NE(observation.landmark, kNone);
}

TEST(FrameMatcher, ALoneOutlierIsWithheldUntilMoreIsSeen) {
  const OldGround seen({0.5});
  EXPECT_EQ(seen.frame[0].landmark, kNone);
  EXPECT_TRUE(seen.frame[0].withheld);
}

TEST(FrameMatcher, FindsATurnThatThePredictionMissed) {
  Options options;
  options.noise_m = 0.02;
  scenes::Random random(2);
  SubmapGraph graph(options.map_bound());
  const Pose truth{rotation_exp(Vec3(0.0, 0.0, 0.3)), Vec3(0.1, 0.0, 0.0)};
  std::vector<Observation> frame;
  const Index submap = graph.add_submap(Pose{});
  graph.activate(submap);
  for (std::size_t i = 0; i < 40; ++i) {
    const Vec3 p(random.uniform(2, 9), random.uniform(-6, 6), random.uniform(-1, 1.5));
    const Index landmark = graph.add_landmark(p, 1);
    graph.observe(graph.join(submap, landmark, p, true), p, 1);
    frame.push_back({truth.inverse() * p, i, kNone});
  }
  FrameMatcher matcher(options, graph);
  Pose found;
  EXPECT_EQ(matcher.search_turn({Pose{}}, 0.4, frame, found), 40);
  EXPECT_LT((found.t - truth.t).norm(), 1e-9);
  EXPECT_LT(rotation_log(found.q * truth.q.conjugate()).norm(), 1e-9);
}

}  // namespace
}  // namespace hallway::slam_point
