// SPDX-License-Identifier: MIT
// Drives with faults at the stated rates: false and missed readings, noise of ranges, tracks that slip, pings that are lost.
#include <gtest/gtest.h>

#include <string>

#include "unit/wall_follower/plans.hpp"

namespace hallway::wall_follower {
namespace {

struct Case {
  const char* name;
  Scene (*scene)();
  int least_closed;  ///< of twelve seeds
};

class Faults12 : public testing::TestWithParam<Case> {};

TEST_P(Faults12, ClosesTheLoopAndNeverWrongly) {
  int closed = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Scene scene = GetParam().scene();
    Drive drive(scene.plan, scene.start, stated_faults(), seed);
    drive.run(600.0);
    if (drive.follower.chart().loop != Loop::closed) continue;
    ++closed;
    EXPECT_LT(drive.closing_error(), 0.6) << "seed " << seed;
  }
  EXPECT_GE(closed, GetParam().least_closed);
}

INSTANTIATE_TEST_SUITE_P(Plans, Faults12,
                         testing::Values(Case{"room", room, 12}, Case{"block", block, 11},
                                         Case{"ring", ring, 11}, Case{"doors", doors, 11},
                                         Case{"staggered", staggered, 11}, Case{"dead_ends", dead_ends, 11},
                                         Case{"ending_wall", ending_wall, 11}, Case{"cabinets", cabinets, 9},
                                         Case{"symmetric", symmetric, 11}),
                         [](const auto& plan) { return std::string(plan.param.name); });

TEST(Faults, TracksThatDoNotSlipAreLearnt) {
  Faults none;
  none.slip = 0.0;
  const Scene scene = room();
  Drive drive(scene.plan, scene.start, none);
  drive.run(300.0);
  EXPECT_EQ(drive.follower.chart().loop, Loop::closed);
  EXPECT_LT(drive.follower.odometer().turn_slip(), 0.05);
}

}  // namespace
}  // namespace hallway::wall_follower
