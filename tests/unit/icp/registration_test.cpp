// SPDX-License-Identifier: MIT
#include "icp/core/registration.hpp"

#include <gtest/gtest.h>

#include "clouds.hpp"

namespace hallway::icp {
namespace {

using clouds::gap;
using clouds::Random;

constexpr std::size_t kNeighbours = 12;

Rules point_rules(Kernel kernel = Kernel::tukey) {
  return {.metric = Metric::point_to_point, .kernel = kernel, .reach_m = 2.0, .max_distance_m = 0.3};
}

Rules plane_rules(Kernel kernel = Kernel::tukey) {
  return {.metric = Metric::point_to_plane, .kernel = kernel, .reach_m = 1.0, .max_distance_m = 0.3};
}

Pose small_motion(Random& random) {
  return clouds::pose(random.in_box({0.15, 0.15, 0.15}), random.uniform(-0.04, 0.04),
                      random.uniform(-0.04, 0.04), random.uniform(-0.04, 0.04));
}

TEST(Registration, PointsSeenAgainGiveTheExactMotion) {
  Random random(1);
  const Points target = clouds::scattered(150, 2);
  for (const Kernel kernel : {Kernel::none, Kernel::huber, Kernel::cauchy, Kernel::tukey}) {
    for (int i = 0; i < 10; ++i) {
      const Pose truth = small_motion(random);
      const Registration found = register_cloud(Target(target, 0), clouds::moved(truth.inverse(), target),
                                                Pose(), point_rules(kernel));
      ASSERT_EQ(found.outcome, Outcome::converged);
      EXPECT_LT(gap(found.T_target_source, truth), 1e-9);
      EXPECT_LT(found.residual_m, 1e-9);
      EXPECT_EQ(found.overlap, 1.0);
    }
  }
}

TEST(Registration, ThereAndBackAreInverse) {
  Random random(3);
  const Points a = clouds::corner(3000, 4, 0.005),
               b = clouds::moved(small_motion(random), clouds::corner(3000, 5, 0.005));
  const Registration there = register_cloud(Target(a, kNeighbours), b, Pose(), plane_rules());
  const Registration back = register_cloud(Target(b, kNeighbours), a, Pose(), plane_rules());
  ASSERT_EQ(there.outcome, Outcome::converged);
  ASSERT_EQ(back.outcome, Outcome::converged);
  EXPECT_LT(gap(there.T_target_source * back.T_target_source, Pose()), 0.02);
}

TEST(Registration, OtherPointsOfTheSameSurfacesGiveTheMotion) {
  Random random(6);
  const Target target(clouds::corner(3000, 7, 0.01), kNeighbours);
  for (int i = 0; i < 3; ++i) {
    const Pose truth = small_motion(random);
    const Points source =
        clouds::moved(truth.inverse(), clouds::corner(2000, 8 + static_cast<std::uint64_t>(i), 0.01));
    const Registration found = register_cloud(target, source, Pose(), plane_rules());
    ASSERT_EQ(found.outcome, Outcome::converged);
    EXPECT_LT(gap(found.T_target_source, truth), 0.03);
    EXPECT_LT(found.residual_m, 0.02);
  }
}

/// Three tenths of the source are elsewhere: near enough to find a match, and all to one side.
Points with_outliers(Points points, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = 0; i < points.size(); i += 10) {
    for (std::size_t k = i; k < std::min(i + 3, points.size()); ++k)
      points[k] += Vec3(random.uniform(0.05, 0.25), random.uniform(0.05, 0.25), 0.0);
  }
  return points;
}

TEST(Registration, RobustWeightsStandThreeTenthsOfOutliers) {
  Random random(9);
  const Points target = clouds::scattered(300, 10);
  for (int i = 0; i < 10; ++i) {
    const Pose truth = small_motion(random);
    const Points source =
        clouds::moved(truth.inverse(), with_outliers(target, 11 + static_cast<std::uint64_t>(i)));
    const Registration robust = register_cloud(Target(target, 0), source, Pose(), point_rules(Kernel::tukey));
    ASSERT_EQ(robust.outcome, Outcome::converged);
    EXPECT_LT(gap(robust.T_target_source, truth), 1e-6);
    const Registration plain = register_cloud(Target(target, 0), source, Pose(), point_rules(Kernel::none));
    EXPECT_GT(gap(plain.T_target_source, truth), 0.02)
        << "the outliers are too weak for the test to mean anything";
  }
}

TEST(Registration, OverlapIsTheLargerShareOfPointsWithAMatch) {
  const Points common = clouds::scattered(200, 12);
  Points more = common, others = common;
  for (int i = 0; i < 50; ++i) {
    more.push_back(Vec3(100.0 + i, 0, 0));
    others.insert(others.end(), {Vec3(0, 100.0 + i, 0), Vec3(0, 200.0 + i, 0)});
  }
  const auto overlap = [](const Points& target, const Points& source) {
    return register_cloud(Target(target, 0), source, Pose(), point_rules()).overlap;
  };
  EXPECT_DOUBLE_EQ(overlap(more, others), 0.8);
  EXPECT_DOUBLE_EQ(overlap(others, more), 0.8);
  EXPECT_DOUBLE_EQ(overlap(common, more), 1.0);
  EXPECT_DOUBLE_EQ(overlap(more, common), 1.0);
}

TEST(Registration, TheOrderOfPointsChangesNothingButRounding) {
  Random random(13);
  for (const Metric metric : {Metric::point_to_point, Metric::point_to_plane}) {
    const Rules rules = metric == Metric::point_to_point ? point_rules() : plane_rules();
    const Points a = clouds::corner(800, 14, 0.01),
                 b = clouds::moved(small_motion(random), clouds::corner(800, 15, 0.01));
    const Registration first = register_cloud(Target(a, kNeighbours), b, Pose(), rules);
    const Registration second =
        register_cloud(Target(clouds::shuffled(a, 16), kNeighbours), clouds::shuffled(b, 17), Pose(), rules);
    EXPECT_EQ(first.outcome, second.outcome);
    EXPECT_EQ(first.iterations, second.iterations);
    EXPECT_LT(gap(first.T_target_source, second.T_target_source), 1e-9);
  }
}

TEST(Registration, FarFromTheOriginItIsAsGood) {
  Random random(18);
  const Vec3 far(4e5, 5e6, 300);
  const Points target = clouds::moved({Eigen::Quaterniond::Identity(), far}, clouds::scattered(150, 19));
  const Pose about{Eigen::Quaterniond::Identity(), far};
  const Pose truth = about * small_motion(random) * about.inverse();
  const Registration found =
      register_cloud(Target(target, 0), clouds::moved(truth.inverse(), target), Pose(), point_rules());
  ASSERT_EQ(found.outcome, Outcome::converged);
  for (const Vec3& p : target) EXPECT_LT((found.T_target_source * (truth.inverse() * p) - p).norm(), 1e-6);
}

TEST(Registration, TooFewPoints) {
  const Points good = clouds::scattered(30, 20);
  for (const Points& few : {Points(), Points{Vec3(1, 0, 0)}, Points{Vec3(1, 0, 0), Vec3(0, 1, 0)},
                            Points(10, Vec3(clouds::kNan, 0, 0)), Points(10, Vec3(0, clouds::kInf, 0)),
                            Points(10, Vec3(0, 0, 1e10))}) {
    EXPECT_EQ(register_cloud(Target(few, kNeighbours), good, Pose(), point_rules()).outcome,
              Outcome::too_few_points);
    EXPECT_EQ(register_cloud(Target(good, kNeighbours), few, Pose(), plane_rules()).outcome,
              Outcome::too_few_points);
  }
}

TEST(Registration, LinesPlanesAndCopiesAreDegenerate) {
  Points line, plane;
  Random random(21);
  for (int i = 0; i < 40; ++i) line.push_back(Vec3(0.1 * i, 0.2 * i, 0.05 * i));
  for (int i = 0; i < 200; ++i) plane.push_back(Vec3(random.uniform(0, 5), random.uniform(0, 5), 0));
  EXPECT_EQ(register_cloud(Target(line, 0), line, Pose(), point_rules()).outcome, Outcome::degenerate);
  EXPECT_EQ(register_cloud(Target(plane, kNeighbours), plane, Pose(), plane_rules()).outcome,
            Outcome::degenerate);
  EXPECT_EQ(register_cloud(Target(plane, 0), plane, Pose(), point_rules()).outcome, Outcome::converged);
  const Points same(20, Vec3(1, 2, 3));
  EXPECT_EQ(register_cloud(Target(same, 0), same, Pose(), point_rules()).outcome, Outcome::degenerate);
  // Points on a line have no normals, and so no matches.
  EXPECT_EQ(register_cloud(Target(line, kNeighbours), line, Pose(), plane_rules()).outcome,
            Outcome::no_overlap);
}

TEST(Registration, CloudsThatAreFarApartHaveNoOverlap) {
  const Points target = clouds::scattered(30, 22);
  const Pose guess = clouds::pose({500, 0, 0}, 0.3);
  const Registration found = register_cloud(Target(target, 0), target, guess, point_rules());
  EXPECT_EQ(found.outcome, Outcome::no_overlap);
  EXPECT_EQ(found.overlap, 0.0);
  EXPECT_EQ(found.residual_m, 0.0);
  EXPECT_EQ(found.iterations, 0);
  EXPECT_EQ(found.T_target_source.t, guess.t);
}

TEST(Registration, PointsThatAreNotUsableChangeNothing) {
  Random random(23);
  const Points a = clouds::scattered(100, 24), b = clouds::moved(small_motion(random), a);
  Points spoilt_a = a, spoilt_b = b;
  for (const double bad : {clouds::kNan, clouds::kInf, -clouds::kInf, 1e300}) {
    for (Points* points : {&spoilt_a, &spoilt_b}) {
      points->insert(points->begin(), Vec3(bad, 0, 0));
      points->insert(points->begin() + 40, Vec3(0, bad, 0));
      points->push_back(Vec3(0, 0, bad));
    }
  }
  const Registration clean = register_cloud(Target(a, 0), b, Pose(), point_rules());
  const Registration spoilt = register_cloud(Target(spoilt_a, 0), spoilt_b, Pose(), point_rules());
  EXPECT_EQ(clean.outcome, spoilt.outcome);
  EXPECT_EQ(clean.overlap, spoilt.overlap);
  EXPECT_LT(gap(clean.T_target_source, spoilt.T_target_source), 1e-12);
}

TEST(Registration, TheLimitOfStepsIsToldAndKept) {
  Random random(25);
  const Points a = clouds::corner(500, 26, 0.02),
               b = clouds::moved(small_motion(random), clouds::corner(500, 27, 0.02));
  Rules rules = plane_rules();
  rules.max_iterations = 2;
  const Registration found = register_cloud(Target(a, kNeighbours), b, Pose(), rules);
  EXPECT_EQ(found.outcome, Outcome::max_iterations);
  EXPECT_EQ(found.iterations, 2);
  EXPECT_GT(found.overlap, 0.5);
}

TEST(Registration, EveryOutcomeHasItsWords) {
  for (const Outcome outcome : {Outcome::converged, Outcome::max_iterations, Outcome::too_few_points,
                                Outcome::no_overlap, Outcome::degenerate}) {
    EXPECT_FALSE(text_of(outcome).empty());
  }
}

}  // namespace
}  // namespace hallway::icp
