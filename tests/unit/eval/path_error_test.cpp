// SPDX-License-Identifier: MIT
#include "eval/path_error.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "eval/association.hpp"
#include "random_motion.hpp"

namespace hallway::eval {
namespace {

constexpr double kRounding = 1e-9;

std::vector<PosePair> random_pairs(std::uint64_t seed, const Pose& T_map_world) {
  std::vector<PosePair> pairs;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const Pose truth = random_motion(seed, i);
    const Pose error{from_yaw_pitch_roll(0.01 * i, -0.02, 0.003 * i), {0.1, 0.002 * i, -0.05}};
    pairs.push_back({truth, T_map_world * (truth * error), 0.1 * i, 2.5 * i});
  }
  return pairs;
}

TEST(AbsoluteError, DoesNotDependOnTheFrameOfTheMap) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const auto here = random_pairs(seed, Pose()), there = random_pairs(seed, random_motion(seed + 90));
    for (const Alignment alignment : {Alignment::kFirstPose, Alignment::kRigid, Alignment::kSimilarity}) {
      const PathError a = absolute_error(here, align(here, alignment));
      const PathError b = absolute_error(there, align(there, alignment));
      EXPECT_NEAR(a.translation_m->rmse, b.translation_m->rmse, kRounding);
      EXPECT_NEAR(a.rotation_deg->max, b.rotation_deg->max, kRounding);
      EXPECT_GT(a.translation_m->median, 0.01);
    }
  }
}

TEST(AbsoluteError, FitsLeaveTheLeastError) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const auto pairs = random_pairs(seed, random_motion(seed + 40));
    const double best = absolute_error(pairs, align(pairs, Alignment::kRigid)).translation_m->rmse;
    const double scaled = absolute_error(pairs, align(pairs, Alignment::kSimilarity)).translation_m->rmse;
    EXPECT_LE(scaled, best + kRounding);
    for (std::uint32_t i = 0; i < 20; ++i) {
      PathFit moved = align(pairs, Alignment::kRigid);
      moved.to += 0.01 * random_motion(seed, i).t.normalized();
      moved.q = from_yaw_pitch_roll(0.001 * i, -0.002, 0.0005 * i) * moved.q;
      EXPECT_GT(absolute_error(pairs, moved).translation_m->rmse, best);
    }
  }
}

TEST(RelativeError, DoesNotDependOnAnyAlignment) {
  const auto here = random_pairs(3, Pose()), there = random_pairs(3, random_motion(77));
  for (const Delta delta :
       {Delta{1, DeltaUnit::kFrames}, Delta{10, DeltaUnit::kMetres}, Delta{1, DeltaUnit::kSeconds}}) {
    const PathError a = relative_error(here, delta), b = relative_error(there, delta);
    ASSERT_TRUE(a.translation_m && b.translation_m);
    EXPECT_NEAR(a.translation_m->rmse, b.translation_m->rmse, kRounding);
    EXPECT_NEAR(a.rotation_deg->max, b.rotation_deg->max, kRounding);
  }
}

TEST(RelativeError, StretchesAreTheFirstThatAreLongEnough) {
  std::vector<PosePair> pairs;
  for (const double metres : {0.0, 0.4, 0.8, 1.0, 1.2, 7.0, 8.5})
    pairs.push_back({.T_world_body = {}, .T_map_body = {}, .t_s = 0, .travelled_m = metres});
  const auto found = stretches(pairs, {1.0, DeltaUnit::kMetres});
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  for (const Stretch& stretch : found) ends.emplace_back(stretch.begin, stretch.end);
  // From 0.4 m on the next one that is 1 m on is at 7 m: a gap.
  EXPECT_EQ(ends, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 3}, {5, 6}}));
  EXPECT_EQ(stretches(pairs, {2.0, DeltaUnit::kFrames}).size(), 5u);
  EXPECT_TRUE(stretches(pairs, {7.0, DeltaUnit::kFrames}).empty());
}

TEST(RelativeError, StepsThatAddUpToTheDeltaButForRoundingReachIt) {
  std::vector<PosePair> pairs;
  double t_s = 1305031102.1;
  for (int i = 0; i < 30; ++i, t_s += 0.1)
    pairs.push_back({.T_world_body = {}, .T_map_body = {}, .t_s = t_s});
  for (const Stretch& stretch : stretches(pairs, {1.0, DeltaUnit::kSeconds}))
    EXPECT_EQ(stretch.end - stretch.begin, 10u);
}

TEST(Alignment, WhatHasNoFitIsAnError) {
  const std::vector<PosePair> two = {PosePair{}, PosePair{}};
  EXPECT_THROW(align({}, Alignment::kNone), Error);
  EXPECT_THROW(align(two, Alignment::kRigid), Error);
  const std::vector<PosePair> rest(5);
  EXPECT_THROW(align(rest, Alignment::kSimilarity), Error);
  EXPECT_NO_THROW(align(rest, Alignment::kRigid));
}

TEST(Association, IsOneToOneAndNearestFirst) {
  const std::vector<double> reference{0.0, 1.0, 2.0, 3.0}, estimate{0.4, 0.9, 1.05, 2.6, 9.0};
  const std::vector<Match> expected{{0, 0}, {1, 2}, {3, 3}};
  EXPECT_EQ(associate(reference, estimate, 0.5), expected);
  EXPECT_EQ(associate(reference, estimate, 0.06), (std::vector<Match>{{1, 2}}));
  EXPECT_TRUE(associate(reference, {}, 1.0).empty());
}

TEST(Association, EqualDifferencesGoToTheEarlierReference) {
  const std::vector<double> reference{1.0, 2.0}, estimate{1.5};
  EXPECT_EQ(associate(reference, estimate, 1.0), (std::vector<Match>{{0, 0}}));
}

}  // namespace
}  // namespace hallway::eval
