// SPDX-License-Identifier: MIT
// Which part of the map the robot is in, and what was joined.
#include "slam_plane/core/gap.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace hallway::slam_plane {
namespace {

Frame frame_that_knows(bool any, bool all) {
  Frame frame;
  frame.in_map.heading = any;
  frame.in_map.open = all ? 0 : 1;
  frame.in_map.direction = Vec2(1, 0);
  return frame;
}

void see(OpenGaps& gaps, const Frame& frame) {
  gaps.watch(frame, Pose2{}, 0.1);
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> joined(const OpenGaps& gaps) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const JoinedPart& part : gaps.joined_parts()) pairs.emplace_back(part.part, part.into);
  return pairs;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

const Frame kTied = frame_that_knows(true, true);
const Frame kAlongAWall = frame_that_knows(true, false);
const Frame kBlind = frame_that_knows(false, false);

TEST(OpenGaps, ADirectionAloneBeginsNoPart) {
  OpenGaps gaps;
  see(gaps, kTied);
  see(gaps, kAlongAWall);
  EXPECT_EQ(gaps.epoch(), 1u);
  EXPECT_EQ(gaps.part(), 0u);
  EXPECT_TRUE(joined(gaps).empty());
}

TEST(OpenGaps, GroundThatNothingTiesIsAPartUntilItIsTied) {
  OpenGaps gaps;
  see(gaps, kTied);
  see(gaps, kBlind);
  see(gaps, kTied);
  EXPECT_EQ(gaps.part(), 1u);
  EXPECT_TRUE(joined(gaps).empty());
  gaps.erase(Gap(gaps.last()));
  EXPECT_EQ(gaps.part(), 0u);
  EXPECT_EQ(joined(gaps), (Pairs{{1, 0}}));
}

TEST(OpenGaps, ABlindTimeBeginsAPartAlsoWhereItBeganAlongAWall) {
  OpenGaps gaps;
  see(gaps, kTied);
  see(gaps, kAlongAWall);
  for (int i = 0; i < 50; ++i) see(gaps, kBlind);
  see(gaps, kAlongAWall);
  EXPECT_EQ(gaps.epoch(), 2u) << "one for the wall, one for the blind time";
  see(gaps, kTied);
  EXPECT_EQ(gaps.part(), 2u);
  gaps.erase(Gap(gaps.last()));
  EXPECT_EQ(gaps.part(), 0u);
  EXPECT_EQ(joined(gaps), (Pairs{{2, 0}}));
}

TEST(OpenGaps, PartsThatAreJoinedInTurnBelongToTheOldest) {
  OpenGaps gaps;
  for (int i = 0; i < 3; ++i) {
    see(gaps, kTied);
    see(gaps, kBlind);
  }
  see(gaps, kTied);
  EXPECT_EQ(gaps.part(), 3u);
  gaps.erase(Gap(gaps.all()[1]));
  EXPECT_EQ(joined(gaps), (Pairs{{2, 1}}));
  gaps.erase(Gap(gaps.last()));
  EXPECT_EQ(gaps.part(), 1u);
  EXPECT_EQ(joined(gaps), (Pairs{{2, 1}, {3, 1}}));
  gaps.erase(Gap(gaps.last()));
  EXPECT_EQ(gaps.part(), 0u);
  EXPECT_EQ(joined(gaps), (Pairs{{1, 0}, {2, 0}, {3, 0}}));
}

TEST(OpenGaps, APartIsNeverNumberedTwice) {
  OpenGaps gaps;
  see(gaps, kBlind);
  gaps.erase(Gap(gaps.last()));
  see(gaps, kBlind);
  EXPECT_EQ(gaps.part(), 2u);
  EXPECT_EQ(joined(gaps), (Pairs{{1, 0}}));
}

}  // namespace
}  // namespace hallway::slam_plane
