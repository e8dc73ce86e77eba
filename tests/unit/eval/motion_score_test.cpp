// SPDX-License-Identifier: MIT
#include "eval/motion_score.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "eval/evaluator.hpp"

namespace hallway::eval {
namespace {

using log::LandmarkStatus;
using Numbers = std::vector<log::LandmarkId>;
using Places = std::vector<Vec3>;

constexpr double kSensorNoise_m = 0.1;  // so that 0.5 m is to have moved

// True landmarks 1 and 2 stand, 3 and 4 move. Those of the map are numbered from 100.
std::vector<log::Landmark> four_landmarks() {
  return {{1, {0, 0, 0}}, {2, {10, 0, 0}}, {3, {0, 10, 0}, true}, {4, {10, 10, 0}, true}};
}

/// Feeds `frames` frames in which each landmark is given to 99 + its own number; 3 and 4 go along x in all by so much.
void feed_motion(Evaluator& evaluator, int frames, double way_of_3_m, double way_of_4_m) {
  for (int f = 0; f < frames; ++f) {
    const double part = static_cast<double>(f) / (frames - 1);
    const Numbers identities{1, 2, 3, 4};
    const Numbers associations{100, 101, 102, 103};
    const Places points{{0, 0, 0}, {10, 0, 0}, {part * way_of_3_m, 10, 0}, {10 + part * way_of_4_m, 10, 0}};
    Iteration iteration;
    iteration.T_world_body = Pose();
    iteration.associations = associations;
    iteration.identities = identities;
    iteration.points = points;
    evaluator.add(iteration);
  }
}

std::vector<log::MapLandmark> map_with(LandmarkStatus of_1, LandmarkStatus of_3, LandmarkStatus of_4) {
  return {{100, {0, 0, 0}, 30, of_1},
          {101, {10, 0, 0}, 30, LandmarkStatus::kMapped},
          {102, {0, 10, 0}, 30, of_3},
          {103, {10, 10, 0}, 30, of_4}};
}

Evaluator moving_evaluator() {
  return Evaluator(Truth{.has_identities = true, .landmarks = four_landmarks(), .noise_m = kSensorNoise_m});
}

constexpr auto kIsMapped = LandmarkStatus::kMapped;
constexpr auto kIsDynamic = LandmarkStatus::kDynamic;

TEST(MotionScore, CountsWhatMovedAndWhatIsMarked) {
  Evaluator scored = moving_evaluator();
  feed_motion(scored, 30, 2.0, 2.0);
  const auto moving = scored.metrics(map_with(kIsDynamic, kIsDynamic, kIsMapped), std::nullopt).moving;
  ASSERT_TRUE(moving);
  EXPECT_EQ(moving->moved, 2u);
  EXPECT_EQ(moving->moved_marked, 1u);
  EXPECT_EQ(moving->marked, 2u);
  EXPECT_EQ(moving->marked_moving, 1u);
  EXPECT_EQ(moving->recall(), 0.5);
  EXPECT_EQ(moving->precision(), 0.5);
}

TEST(MotionScore, AsksForFiveNoisesAndTwentyFrames) {
  Evaluator slow = moving_evaluator();
  feed_motion(slow, 30, 2.0, 0.4);  // 4 has not gone 5 noises
  EXPECT_EQ(slow.metrics(map_with(kIsMapped, kIsDynamic, kIsDynamic), std::nullopt).moving->moved, 1u);
  Evaluator brief = moving_evaluator();
  feed_motion(brief, 19, 2.0, 2.0);
  const auto moving = brief.metrics(map_with(kIsMapped, kIsDynamic, kIsDynamic), std::nullopt).moving;
  EXPECT_EQ(moving->moved, 0u);
  EXPECT_FALSE(moving->recall());
  EXPECT_EQ(moving->precision(), 1.0);  // what moves too little is no false alarm
}

TEST(MotionScore, TheFirstSightingsNoiseIsNoMotion) {
  Evaluator scored = moving_evaluator();
  feed_motion(scored, 30, 0.0, 0.0);
  EXPECT_EQ(scored.metrics(map_with(kIsMapped, kIsMapped, kIsMapped), std::nullopt).moving->moved, 0u);
  EXPECT_FALSE(scored.metrics(map_with(kIsMapped, kIsMapped, kIsMapped), std::nullopt).moving->precision());
}

TEST(MotionScore, WhatMovesIsInNoOtherNumberOfLandmarks) {
  Evaluator scored = moving_evaluator();
  feed_motion(scored, 30, 2.0, 2.0);
  const Metrics metrics = scored.metrics(map_with(kIsMapped, kIsMapped, kIsDynamic), std::nullopt);
  EXPECT_EQ(metrics.landmarks_true, 2u);
  EXPECT_EQ(metrics.landmarks_missed, 0u);
  EXPECT_EQ(metrics.landmarks_duplicated, 0u);
  EXPECT_EQ(metrics.landmark_pairs, 2u);
  EXPECT_EQ(metrics.landmarks_mapped, 3u);  // what the plugin says
}

TEST(MotionScore, IsUnknownWithoutTruth) {
  EXPECT_FALSE(Evaluator(Truth{}).metrics({}, std::nullopt).moving);
  EXPECT_FALSE(Evaluator(Truth{true, std::nullopt}).metrics({}, std::nullopt).moving);
}

}  // namespace
}  // namespace hallway::eval
