// SPDX-License-Identifier: MIT
#include "slam_point/core/submaps/submap_sequence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr bool kByPlace = false;
constexpr bool kByTracks = true;

/// A sequence of submaps of a map whose landmarks lie where they are said to lie.
class Sequence {
 public:
  explicit Sequence(const Options& options = {}) : options_(options) {}

  Index add_landmark(const Vec3& place) {
    places_.push_back(place);
    return graph.add_landmark(place, submaps.activation());
  }
  void add_landmarks(int count, std::uint64_t seed) {
    scenes::Random random(seed);
    for (int i = 0; i < count; ++i)
      add_landmark(Vec3(random.uniform(3, 12), random.uniform(-8, 8), random.uniform(-3, 3)));
  }

  /// What a sensor at T_map_sensor sees of some landmarks, and what it takes them for.
  Observations see(const std::vector<Index>& landmarks, const Pose& T_map_sensor = {}) const {
    Observations frame;
    for (const Index l : landmarks) frame.push_back({T_map_sensor.inverse() * places_[l], frame.size(), l});
    return frame;
  }
  std::size_t integrate(const std::vector<Index>& landmarks, const Pose& T_map_sensor = {},
                        const Pose& T_submap_sensor = {}) {
    return submaps.integrate(see(landmarks, T_map_sensor), T_submap_sensor);
  }
  std::size_t close(Observations& observations, bool followed = kByPlace) {
    Frame frame{observations, false, followed};
    const std::size_t merged = submaps.close(motion_filter, frame);
    observations = frame.observations;
    return merged;
  }
  void close() {
    Observations frame;
    close(frame);
  }

  const Member& member(Index submap, Index landmark) const {
    const std::vector<Member>& members = graph.submaps[submap].members;
    return *std::find_if(members.begin(), members.end(),
                         [&](const Member& m) { return m.landmark == landmark; });
  }

 private:
  Options options_;
  std::vector<Vec3> places_{};

 public:
  SubmapGraph graph{options_.map_bound()};
  FrameMatcher matcher{options_, graph};
  MotionFilter motion_filter{options_, graph};
  SubmapSequence submaps{options_, graph, matcher};
};

TEST(SubmapSequence, ASubmapIsOverWhenTooLittleOfItsFirstFrameIsInView) {
  Sequence sequence;
  sequence.add_landmarks(20, 1);
  sequence.submaps.open_new(Pose{});
  sequence.integrate({0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  EXPECT_FALSE(sequence.submaps.is_over(sequence.see({0, 1, 2, 3, 4, 5, 6, 7, 8, 9})));
  EXPECT_FALSE(sequence.submaps.is_over(sequence.see({0, 1, 2, 3, 4, 5, 6, 7}))) << "8 of 10 are not less";
  EXPECT_TRUE(sequence.submaps.is_over(sequence.see({0, 1, 2, 3, 4, 5, 6}))) << "7 of 10";
  sequence.integrate({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  EXPECT_FALSE(sequence.submaps.is_over(sequence.see({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}))) << "9 of 11";
  EXPECT_TRUE(sequence.submaps.is_over(sequence.see({2, 3, 4, 5, 6, 7, 8, 9, 10, 11})))
      << "8 of 12: 10 and 11 came later";
}

TEST(SubmapSequence, ASubmapIsOverAfterSoManyFrames) {
  Options options;
  options.max_submap_frames = 3;
  Sequence sequence(options);
  sequence.add_landmarks(10, 2);
  const std::vector<Index> all{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  sequence.submaps.open_new(Pose{});
  for (int frame = 1; frame < 3; ++frame) {
    sequence.integrate(all);
    EXPECT_FALSE(sequence.submaps.is_over(sequence.see(all))) << frame;
  }
  sequence.integrate(all);
  EXPECT_TRUE(sequence.submaps.is_over(sequence.see(all)));
}

TEST(SubmapSequence, AFrameIsAveragedIntoTheActiveSubmapByHand) {
  Sequence sequence;
  for (const Vec3& p : {Vec3(11, 0, 0), Vec3(12, 0, 0), Vec3(13, 2, 0), Vec3(14, 2, 2)})
    sequence.add_landmark(p);
  const Pose T_map_submap{Eigen::Quaterniond::Identity(), Vec3(10, 0, 0)};
  sequence.submaps.open_new(T_map_submap);
  Observations frame{{Vec3(1, 0, 0), 0, 0}, {Vec3(9, 9, 9), 1}, {Vec3(2, 0, 0), 2, 1}, {Vec3(3, 2, 0), 3, 2}};
  EXPECT_EQ(sequence.submaps.integrate(frame, Pose{}), 3u) << "one is no landmark";
  // One metre on the second frame sees the first landmark 0.2 m to the left and three times as exactly, and the last one.
  const Pose T_submap_sensor{Eigen::Quaterniond::Identity(), Vec3(1, 0, 0)};
  frame = {{Vec3(0, 0.2, 0), 0, 0}, {Vec3(3, 2, 2), 1, 3}};
  frame[0].weight = 3.0;
  EXPECT_EQ(sequence.submaps.integrate(frame, T_submap_sensor), 2u);
  ASSERT_EQ(sequence.graph.submaps[0].members.size(), 4u);
  EXPECT_EQ(sequence.graph.submaps[0].first_frame_size, 3u);
  EXPECT_FALSE(sequence.member(0, 3).in_first_frame);
  EXPECT_EQ(sequence.member(0, 0).count, 2u);
  EXPECT_LT((sequence.member(0, 0).mean - Vec3(1, 0.15, 0)).norm(), 1e-12);
  EXPECT_LT((sequence.graph.landmarks[0].position - Vec3(11, 0.15, 0)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(sequence.graph.landmarks[0].weight, 4.0);
  EXPECT_LT((sequence.member(0, 3).mean - Vec3(4, 2, 2)).norm(), 1e-12);
  EXPECT_EQ(sequence.submaps.segments().frames(), 2u);
  EXPECT_EQ(sequence.submaps.segments().observations(), 5u);
}

TEST(SubmapSequence, CountsTheSubmapsThatAreTakenUp) {
  Options options;
  options.window = 2;
  Sequence sequence(options);
  sequence.add_landmarks(6, 3);
  for (std::uint64_t taken = 1; taken <= 4; ++taken) {
    sequence.submaps.open_new(Pose{});
    sequence.integrate({0, 1, 2});
    EXPECT_EQ(sequence.submaps.activation(), taken);
    EXPECT_EQ(sequence.submaps.local_since(), taken <= 2 ? 0 : taken - 2);
    EXPECT_EQ(sequence.graph.landmarks[0].last_activation, taken);
    sequence.close();
  }
  // An old one that is taken up again counts, too.
  EXPECT_TRUE(sequence.submaps.take_up(sequence.see({0, 1, 2}), Pose{}).reopened);
  EXPECT_EQ(sequence.submaps.activation(), 5u);
}

/// Some submaps that each saw six landmarks of their own and two of the one before.
struct Road : Sequence {
  explicit Road(const Options& options = {}) : Sequence(options) {
    add_landmarks(24, 4);
    for (Index s = 0; s < 3; ++s) {
      submaps.open_new(pose(s));
      integrate(seen(s), pose(s));
      close();
    }
  }
  static Pose pose(Index s) { return scenes::heading(Vec3(0.3 * s, 0.1, 0), 0.2 * s); }
  static std::vector<Index> seen(Index s) {
    std::vector<Index> landmarks;
    for (Index l = 6 * s; l < 6 * s + 8; ++l) landmarks.push_back(l);
    return landmarks;
  }
};

TEST(SubmapSequence, TakesUpTheSubmapThatIsMostInView) {
  Road road;
  const SubmapSequence::Taken taken =
      road.submaps.take_up(road.see(Road::seen(1), Road::pose(1)), Road::pose(1));
  EXPECT_TRUE(taken.reopened);
  EXPECT_EQ(road.graph.active(), 1u);
  EXPECT_EQ(road.graph.submaps.size(), 3u);
  EXPECT_LT(taken.T_submap_sensor.t.norm(), 1e-9);
}

TEST(SubmapSequence, ASubmapThatIsTakenUpTellsItselfWhereTheFrameIs) {
  Road road;
  // The submap has drifted by more than a match would bear, its own evidence has not.
  const Pose T_submap_sensor{rotation_exp(Vec3(0.02, -0.01, 0.05)), Vec3(0.2, -0.1, 0.05)};
  const Observations frame = road.see(Road::seen(1), Road::pose(1) * T_submap_sensor);
  const Pose drifted{Eigen::Quaterniond::Identity(), Vec3(0.3, -0.5, 0.2)};
  const SubmapSequence::Taken taken = road.submaps.take_up(frame, drifted * Road::pose(1) * T_submap_sensor);
  ASSERT_TRUE(taken.reopened);
  EXPECT_LT((taken.T_submap_sensor.t - T_submap_sensor.t).norm(), 1e-9);
  EXPECT_LT(taken.T_submap_sensor.q.angularDistance(T_submap_sensor.q), 1e-9);
  // Members that join now were not in its first frame.
  std::vector<Index> more = Road::seen(1);
  more.push_back(20);
  road.integrate(more, Road::pose(1), Pose{});
  EXPECT_FALSE(road.member(1, 20).in_first_frame);
  EXPECT_EQ(road.graph.submaps[1].first_frame_size, 8u);
  EXPECT_EQ(road.member(1, 8).count, 2u);
}

TEST(SubmapSequence, OpensANewSubmapWhereNoneIsInView) {
  Road road;
  const Pose here = scenes::heading(Vec3(5, 6, 0), 1.0);
  const SubmapSequence::Taken taken = road.submaps.take_up(road.see({3, 4, 5, 6, 7, 8, 9, 10}, here), here);
  EXPECT_FALSE(taken.reopened);
  EXPECT_EQ(taken.T_submap_sensor.t, Vec3::Zero());
  EXPECT_EQ(taken.T_submap_sensor.q.vec(), Vec3::Zero());
  EXPECT_EQ(road.graph.active(), 3u);
  EXPECT_EQ(road.graph.poses[3].t, here.t);
  road.integrate({3, 4, 5, 6, 7, 8, 9, 10}, here);
  EXPECT_EQ(road.graph.submaps[3].first_frame_size, 8u);
}

TEST(SubmapSequence, OpensANewSubmapWhereTheOldOneLeavesTheFrameOpen) {
  Sequence sequence;
  for (int i = 0; i < 8; ++i) sequence.add_landmark(Vec3(3.0 + i, 1, 0));  // on a line
  const std::vector<Index> all{0, 1, 2, 3, 4, 5, 6, 7};
  sequence.submaps.open_new(Pose{});
  sequence.integrate(all);
  sequence.close();
  EXPECT_FALSE(sequence.submaps.take_up(sequence.see(all), Pose{}).reopened);
  EXPECT_EQ(sequence.graph.active(), 1u);
  EXPECT_EQ(sequence.submaps.activation(), 2u);
}

TEST(SubmapSequence, AtItsCloseASubmapsFramesAreAlignedToEachOther) {
  // How far the distances between landmarks are wrong when the second of two exact frames was placed 0.04 rad wrong.
  const auto distortion = [](int sweeps) {
    Options options;
    options.sweeps = sweeps;
    Sequence sequence(options);
    sequence.add_landmarks(8, 5);
    const std::vector<Index> all{0, 1, 2, 3, 4, 5, 6, 7};
    sequence.submaps.open_new(Pose{});
    sequence.integrate(all);
    sequence.integrate(all, Pose{}, {rotation_exp(Vec3(0, 0, 0.04)), Vec3::Zero()});
    sequence.close();
    double worst = 0.0;
    for (const Index a : all) {
      for (const Index b : all) {
        const double truth = (sequence.see({a})[0].point - sequence.see({b})[0].point).norm();
        const double told =
            (sequence.graph.landmarks[a].position - sequence.graph.landmarks[b].position).norm();
        worst = std::max(worst, std::abs(told - truth));
      }
    }
    return worst;
  };
  EXPECT_GT(distortion(0), 1e-3);
  EXPECT_LT(distortion(1), 1e-9);
}

TEST(SubmapSequence, AClosedSubmapIsNoMoreTheActiveOne) {
  Sequence sequence;
  sequence.add_landmarks(8, 6);
  sequence.submaps.open_new(Pose{});
  sequence.integrate({0, 1, 2, 3});
  sequence.close();
  EXPECT_EQ(sequence.graph.active(), kNone);
  for (const LandmarkRecord& landmark : sequence.graph.landmarks) EXPECT_EQ(landmark.active_member, kNone);
  EXPECT_EQ(sequence.graph.landmarks[0].settled_count, 1u);
}

/// Six landmarks; the second submap took the first of them for a new one, 0.1 m beside it: number 6.
struct Twice : Sequence {
  Twice() {
    add_landmarks(6, 7);
    twin = add_landmark(graph.landmarks[0].position + Vec3(0.1, 0, 0));
    submaps.open_new(Pose{});
    integrate({0, 1, 2, 3, 4, 5});
    close();
    submaps.open_new(Pose{});
    integrate({twin, 1, 2, 3, 4, 5});
  }
  Index twin = kNone;
};

TEST(SubmapSequence, LandmarksThatLieOnEachOtherAreMadeOneAtTheClose) {
  Twice twice;
  Observations frame = twice.see({5, twice.twin, 1});
  EXPECT_EQ(twice.close(frame), 1u);
  EXPECT_EQ(twice.graph.landmarks[twice.twin].merged_into, 0u);
  EXPECT_EQ(twice.graph.landmarks[0].count, 2u);
  EXPECT_EQ(frame[0].landmark, 5u);
  EXPECT_EQ(frame[1].landmark, 0u) << "the match follows";
  EXPECT_EQ(frame[2].landmark, 1u);
}

TEST(SubmapSequence, WhatIsSeenTogetherIsNotMadeOne) {
  Twice in_view;
  Observations frame = in_view.see({0, in_view.twin, 1});
  EXPECT_EQ(in_view.close(frame), 0u);
  Twice before;
  before.motion_filter.judge(before.submaps.active(), Pose{}, frame);
  Observations none;
  EXPECT_EQ(before.close(none), 0u);
}

TEST(SubmapSequence, WhatTheSensorTellsApartIsNotMadeOne) {
  Twice twice;
  Observations frame = twice.see({twice.twin, 1, 2});
  EXPECT_EQ(twice.close(frame, kByTracks), 0u);
  EXPECT_EQ(frame[0].landmark, twice.twin);
}

/// Whether the whole map is placed anew after three submaps, one activation old each, when the last one saw the landmarks of `seen`.
bool places_map_anew(Index seen) {
  Options options;
  options.window = 1;
  options.global_period = 1;
  Sequence sequence(options);
  for (Index s = 0; s < 3; ++s) {
    sequence.submaps.open_new(Pose{});
    sequence.add_landmarks(5, 8 + s);
    sequence.integrate({5 * s, 5 * s + 1, 5 * s + 2, 5 * s + 3, 5 * s + 4});
    if (s == 2) sequence.integrate({5 * seen, 5 * seen + 1, 5 * seen + 2});
    sequence.close();
  }
  sequence.submaps.open_new(Pose{});
  bool anew = false;
  for (std::uint64_t frame = 0; frame < 20; ++frame) {
    anew = sequence.submaps.schedule().apply(sequence.graph, 0.0025) || anew;
    sequence.submaps.schedule().advance(frame);
  }
  return anew;
}

TEST(SubmapSequence, OldGroundInViewMeansThatTheWholeMapIsPlacedAnew) {
  EXPECT_TRUE(places_map_anew(0)) << "seen two activations ago";
  EXPECT_FALSE(places_map_anew(1)) << "within the window of one";
}

TEST(SubmapSequence, BeginsAnewButCountsOn) {
  Road road;
  road.graph.clear();
  road.submaps.clear();
  EXPECT_EQ(road.submaps.activation(), 3u);
  EXPECT_EQ(road.submaps.segments().frames(), 0u);
  EXPECT_EQ(road.submaps.active().frames(), 0u);
}

TEST(SubmapSequence, GivesTheSameBitsEveryTime) {
  const auto positions = [] {
    Road road;
    scenes::Random random(9);
    std::vector<Vec3> told;
    for (int round = 0; round < 10; ++round) {
      const auto s = static_cast<Index>(random.uniform(0.0, 3.0));
      Observations frame = road.see(Road::seen(s), Road::pose(s));
      for (Observation& observation : frame)
        observation.point += 0.05 * Vec3(random.normal(), random.normal(), random.normal());
      const Pose T = road.submaps.take_up(frame, Road::pose(s)).T_submap_sensor;
      road.submaps.integrate(frame, T);
      road.close(frame);
    }
    for (const LandmarkRecord& landmark : road.graph.landmarks) told.push_back(landmark.position);
    return told;
  };
  EXPECT_EQ(positions(), positions());
}

}  // namespace
}  // namespace hallway::slam_point
