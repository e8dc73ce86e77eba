// SPDX-License-Identifier: MIT
#include "icp/core/align.hpp"

#include <gtest/gtest.h>

#include "clouds.hpp"

namespace hallway::icp {
namespace {

using clouds::gap;
using clouds::Random;

TEST(Align, FindsTheMotionOfTwoScansOfOneRoom) {
  const Pose truth = clouds::pose({0.4, -0.3, 0.2}, 0.15, -0.05, 0.1);
  const Points a = clouds::corner(8000, 1, 0.005),
               b = clouds::moved(truth.inverse(), clouds::corner(6000, 2, 0.005));
  for (const Metric metric : {Metric::point_to_point, Metric::point_to_plane}) {
    const Alignment found = align(a, b, Pose(), {.metric = metric});
    ASSERT_EQ(found.registration.outcome, Outcome::converged);
    EXPECT_LT(gap(found.registration.T_target_source, truth), metric == Metric::point_to_plane ? 0.02 : 0.1);
    EXPECT_GT(found.registration.overlap, 0.95);
    EXPECT_GT(found.cube_m, 0.0);
    EXPECT_LE(found.used_a, a.size());
  }
}

TEST(Align, InMillimetresTheMotionIsAThousandTimesAsLong) {
  const Pose truth = clouds::pose({0.2, -0.1, 0.1}, 0.1);
  Points a = clouds::corner(4000, 3, 0.005),
         b = clouds::moved(truth.inverse(), clouds::corner(4000, 4, 0.005));
  const Pose metres = align(a, b, Pose(), {}).registration.T_target_source;
  for (Points* points : {&a, &b}) {
    for (Vec3& p : *points) p *= 1000.0;
  }
  const Alignment found = align(a, b, Pose(), {});
  ASSERT_EQ(found.registration.outcome, Outcome::converged);
  Pose scaled = found.registration.T_target_source;
  scaled.t /= 1000.0;
  EXPECT_LT(gap(scaled, metres), 1e-3);
}

TEST(Align, TheOrderOfPointsChangesNothing) {
  const Points a = clouds::corner(3000, 5, 0.01), b = clouds::moved(clouds::pose({0.1, 0, 0}, 0.05), a);
  const Alignment first = align(a, b, Pose(), {});
  const Alignment second = align(clouds::shuffled(a, 6), clouds::shuffled(b, 7), Pose(), {});
  EXPECT_EQ(first.used_a, second.used_a);
  EXPECT_EQ(first.registration.iterations, second.registration.iterations);
  EXPECT_LT(gap(first.registration.T_target_source, second.registration.T_target_source), 1e-12);
}

TEST(Align, WhatIsGivenIsUsed) {
  const Points a = clouds::corner(2000, 8);
  const Alignment found =
      align(a, a, Pose(), {.cube_m = 0.0, .max_distance_m = 0.25, .reach_m = 0.1, .max_iterations = 7});
  EXPECT_EQ(found.cube_m, 0.0);
  EXPECT_EQ(found.used_a, a.size());
  EXPECT_EQ(found.rules.max_distance_m, 0.25);
  EXPECT_EQ(found.rules.reach_m, 0.25) << "never below the last distance";
  EXPECT_EQ(found.rules.max_iterations, 7);
}

TEST(Align, BadCloudsHaveAnOutcome) {
  const Points good = clouds::corner(500, 9);
  Points wide;
  Random random(10);
  for (int i = 0; i < 50; ++i) wide.push_back(random.in_box({1e9, 1e9, 1e9}));
  for (const Points& bad : {Points(), Points{Vec3(1, 2, 3)}, Points(2, Vec3(0, 0, 0)),
                            Points(50, Vec3(1, 1, 1)), Points(9, Vec3(clouds::kNan, 0, 0)), wide}) {
    EXPECT_NE(align(bad, good, Pose(), {}).registration.outcome, Outcome::converged);
    EXPECT_NE(align(good, bad, Pose(), {}).registration.outcome, Outcome::converged);
  }
  EXPECT_NE(align(Points(50, Vec3(1, 1, 1)), Points(50, Vec3(1, 1, 1)), Pose(), {}).registration.outcome,
            Outcome::converged);
}

}  // namespace
}  // namespace hallway::icp
