// SPDX-License-Identifier: MIT
#include "icp/core/localiser.hpp"

#include <gtest/gtest.h>

#include "clouds.hpp"

namespace hallway::icp {
namespace {

using clouds::gap;
using clouds::Random;

constexpr Against kAll[] = {Against::previous, Against::keyframe, Against::map};

Options options_against(Against against) {
  Options options;
  options.against = against;
  return options;
}

/// Points above a long lane; a sensor drives along it and sees what is less than 12 m away.
struct Lane {
  explicit Lane(std::uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < 1500; ++i) landmarks.push_back(random.in_box({40, 10, 3}) + Vec3(30, 0, 0));
  }
  static Pose pose_at(int frame) {
    return clouds::pose({0.1 * frame, 0.001 * frame * frame, 0}, 0.004 * frame, 0.001 * frame);
  }
  Points seen(int frame, double noise_m = 0.0) const {
    Random random(1000 + static_cast<std::uint64_t>(frame));
    Points points;
    const Pose T_sensor_world = (pose_at(0) * pose_at(frame)).inverse();
    for (const Vec3& landmark : landmarks) {
      const Vec3 p = T_sensor_world * landmark;
      if (p.norm() < 12.0) points.push_back(p + random.noise(noise_m));
    }
    return points;
  }
  Points landmarks;
};

TEST(Localiser, WithoutNoiseItFollowsExactly) {
  const Lane lane(1);
  for (const Against against : kAll) {
    Localiser localiser(options_against(against));
    for (int frame = 0; frame < 60; ++frame) {
      const Answer& answer =
          localiser.process(clouds::shuffled(lane.seen(frame), static_cast<std::uint64_t>(frame)));
      ASSERT_TRUE(answer.has_pose) << frame;
      EXPECT_LT(gap(answer.T_map_sensor, Lane::pose_at(frame)), 1e-6) << frame;
    }
  }
}

TEST(Localiser, WithNoiseAMapDriftsLessThanFrameToFrame) {
  const Lane lane(2);
  double errors[2] = {};
  for (const Against against : {Against::previous, Against::map}) {
    Localiser localiser(options_against(against));
    for (int frame = 0; frame < 100; ++frame) {
      const Answer& answer = localiser.process(lane.seen(frame, 0.02));
      ASSERT_TRUE(answer.has_pose) << frame;
      errors[against == Against::map ? 1 : 0] += gap(answer.T_map_sensor, Lane::pose_at(frame)) / 100.0;
    }
  }
  EXPECT_LT(errors[1], errors[0]);
  EXPECT_LT(errors[0], 0.5);
}

TEST(Localiser, TheMapHasEachLandmarkOnce) {
  const Lane lane(3);
  Localiser localiser(options_against(Against::map));
  std::uint64_t observed = 0;
  for (int frame = 0; frame < 40; ++frame) {
    const Points points = lane.seen(frame);
    const Answer& answer = localiser.process(points);
    ASSERT_TRUE(answer.has_pose);
    ASSERT_EQ(answer.associations.size(), points.size());
    const std::vector<Landmark> landmarks = localiser.landmarks();
    EXPECT_EQ(answer.counters.landmarks, landmarks.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_LT(answer.associations[i], landmarks.size());
      // Landmarks nearer to each other than the separation count as one.
      EXPECT_LT((landmarks[answer.associations[i]].position - Lane::pose_at(frame) * points[i]).norm(), 1.0);
    }
    observed += points.size();
  }
  std::uint64_t counted = 0;
  for (const Landmark& landmark : localiser.landmarks()) counted += landmark.observations;
  EXPECT_EQ(counted, observed);
  EXPECT_LE(localiser.landmarks().size(), lane.landmarks.size());
}

TEST(Localiser, OnlyTheMapHasLandmarks) {
  const Lane lane(4);
  for (const Against against : {Against::previous, Against::keyframe}) {
    Localiser localiser(options_against(against));
    EXPECT_TRUE(localiser.process(lane.seen(0)).associations.empty());
    EXPECT_TRUE(localiser.landmarks().empty());
  }
}

TEST(Localiser, AKeyframeStaysWhileEnoughOfItIsInView) {
  const Lane lane(5);
  Options options = options_against(Against::keyframe);
  Localiser localiser(options);
  std::uint64_t keyframes = 0;
  for (int frame = 0; frame < 100; ++frame)
    keyframes = localiser.process(lane.seen(frame)).counters.keyframes;
  EXPECT_GE(keyframes, 2u);
  EXPECT_LE(keyframes, 20u);
}

TEST(Localiser, ASuddenTurnIsSearchedFor) {
  const Points points = clouds::scattered(200, 6);
  const Pose turn = clouds::pose({0.05, 0.02, 0}, 1.0);
  for (const double max_turn : {1.2, 0.0}) {
    Options options;
    options.max_turn_rad = max_turn;
    Localiser localiser(options);
    localiser.process(points);
    localiser.process(points);
    const Answer& answer = localiser.process(clouds::moved(turn.inverse(), points));
    EXPECT_EQ(answer.has_pose, max_turn > 0.0);
    if (!answer.has_pose) continue;
    EXPECT_LT(gap(answer.T_map_sensor, turn), 1e-6);
    EXPECT_EQ(answer.counters.searches, 1u);
  }
}

TEST(Localiser, NothingToRegisterIsLostAndThePoseComesBack) {
  const Lane lane(7);
  for (const Against against : kAll) {
    Localiser localiser(options_against(against));
    for (int frame = 0; frame < 40; ++frame) {
      const bool dark = frame >= 20 && frame < 23;
      const Answer& answer = localiser.process(dark ? Points() : lane.seen(frame));
      ASSERT_EQ(answer.has_pose, !dark) << frame;
      if (answer.has_pose) {
        EXPECT_LT(gap(answer.T_map_sensor, Lane::pose_at(frame)), 1e-6);
      }
    }
    EXPECT_EQ(localiser.process(lane.seen(40)).counters.lost, 3u);
  }
}

TEST(Localiser, ASampleOfAFrameIsEnough) {
  const Lane lane(14);
  Options options;
  options.max_points = 60;
  Localiser localiser(options);
  for (int frame = 0; frame < 30; ++frame) {
    const Answer& answer = localiser.process(lane.seen(frame));
    ASSERT_GT(lane.seen(frame).size(), 200u);
    ASSERT_TRUE(answer.has_pose) << frame;
    EXPECT_LT(gap(answer.T_map_sensor, Lane::pose_at(frame)), 1e-6);
  }
}

TEST(Localiser, AnotherPlaceIsLost) {
  const Lane lane(8);
  Localiser localiser{Options()};
  localiser.process(lane.seen(0));
  localiser.process(lane.seen(1));
  const Answer& answer = localiser.process(clouds::scattered(300, 9));
  EXPECT_FALSE(answer.has_pose);
  EXPECT_TRUE(localiser.process(lane.seen(3)).has_pose);
}

TEST(Localiser, PointsThatDetermineNoPoseStartNothing) {
  for (const Against against : kAll) {
    Localiser localiser(options_against(against));
    Points line;
    for (int i = 0; i < 20; ++i) line.push_back(Vec3(i, 0.5 * i, 0));
    for (const Points& points : {Points(), Points{Vec3(1, 2, 3)}, Points(9, Vec3(1, 1, 1)), line,
                                 Points(9, Vec3(clouds::kNan, 0, 0))}) {
      EXPECT_FALSE(localiser.process(points).has_pose);
    }
    EXPECT_TRUE(localiser.process(clouds::scattered(30, 10)).has_pose);
  }
}

TEST(Localiser, AFalseFirstFrameIsReplaced) {
  Localiser localiser(options_against(Against::map));
  EXPECT_TRUE(localiser.process(clouds::scattered(10, 11)).has_pose);
  EXPECT_EQ(localiser.process({}).epoch, 0u);
  EXPECT_TRUE(
      localiser.process(clouds::moved(clouds::pose({300, 0, 0}, 0), clouds::scattered(100, 12))).has_pose);
  EXPECT_EQ(localiser.process({}).epoch, 1u) << "the poses are in another map";
  EXPECT_GT(localiser.landmarks().size(), 50u);
  EXPECT_LE(localiser.landmarks().size(), 100u) << "those of the first frame are gone";
}

TEST(Localiser, AfterAResetTheAnswersAreTheSame) {
  const Lane lane(13);
  Localiser localiser(options_against(Against::map));
  std::vector<Pose> first;
  for (int frame = 0; frame < 10; ++frame)
    first.push_back(localiser.process(lane.seen(frame, 0.01)).T_map_sensor);
  localiser.reset();
  EXPECT_TRUE(localiser.landmarks().empty());
  for (int frame = 0; frame < 10; ++frame) {
    const Answer& answer = localiser.process(lane.seen(frame, 0.01));
    EXPECT_EQ(answer.T_map_sensor.t, first[static_cast<std::size_t>(frame)].t);
    EXPECT_EQ(answer.counters.lost, 0u);
  }
}

TEST(Localiser, EveryDefaultIsWithinItsRange) {
  const Options options;
  for (const OptionRow<Options>& row : parameters()) {
    ASSERT_NE(row.real != nullptr, row.whole != nullptr) << row.name;
    const double value = row.real != nullptr ? options.*row.real : options.*row.whole;
    EXPECT_GE(value, row.min) << row.name;
    EXPECT_LE(value, row.max) << row.name;
  }
}

}  // namespace
}  // namespace hallway::icp
