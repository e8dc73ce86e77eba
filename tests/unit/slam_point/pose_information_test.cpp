// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/pose_information.hpp"

#include <gtest/gtest.h>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"
#include "support/dense.hpp"

namespace hallway::slam_point {
namespace {

struct Matched {
  Vec3 point;
  double weight;
};

std::vector<Matched> some_matches(bool planar) {
  scenes::Random random(3);
  std::vector<Matched> matches;
  for (int i = 0; i < 12; ++i)
    matches.push_back(
        {Vec3(random.uniform(2, 9), random.uniform(-5, 5), planar ? 0.0 : random.uniform(-3, 3)),
         random.uniform(0.5, 1.0)});
  return matches;
}

std::optional<Mat6> covariance_of(const std::vector<Matched>& matches, const Pose& T, bool planar) {
  PoseInformation information;
  for (const Matched& match : matches) information.add(T.q * match.point, match.weight);
  return information.covariance(planar);
}

TEST(PoseInformation, IsTheInverseOfTheSummedSquaresOfDerivatives) {
  const Pose T = {rotation_exp(Vec3(0.3, -0.5, 1.0)), Vec3(4, 5, 6)};
  Mat6 information = Mat6::Zero();
  for (const Matched& match : some_matches(false)) {
    Eigen::Matrix<double, 3, 6> derivative;
    for (int i = 0; i < 6; ++i) {
      constexpr double kStep = 1e-6;
      const Vec3 unit = Vec3::Unit(i % 3) * kStep;
      const Pose moved = i < 3 ? Pose{T.q, T.t + unit} : Pose{rotation_exp(unit) * T.q, T.t};
      derivative.col(i) = (moved * match.point - T * match.point) / kStep;
    }
    information += match.weight * derivative.transpose() * derivative;
  }
  const auto covariance = covariance_of(some_matches(false), T, false);
  ASSERT_TRUE(covariance);
  EXPECT_LT((*covariance * information - Mat6::Identity()).norm(), 1e-4);
}

TEST(PoseInformation, InPlanarDataOnlyXYAndYawVary) {
  const auto covariance = covariance_of(some_matches(true), scenes::heading(Vec3(1, 2, 0), 0.7), true);
  ASSERT_TRUE(covariance);
  for (const int fixed : {2, 3, 4}) {
    EXPECT_TRUE(covariance->row(fixed).isZero(0.0));
    EXPECT_TRUE(covariance->col(fixed).isZero(0.0));
  }
  for (const int free : {0, 1, 5}) EXPECT_GT((*covariance)(free, free), 0.0);
}

TEST(PoseInformation, WhatLeavesADirectionOpenHasNoCovariance) {
  EXPECT_FALSE(PoseInformation().covariance(false));
  EXPECT_FALSE(PoseInformation().covariance(true));
}

// The errors of fits to exact landmarks, over many noises.
TEST(PoseInformation, FitsErrAsItSays) {
  constexpr double kNoise_m = 0.02;
  constexpr int kRuns = 2000;
  const std::vector<Matched> matches = some_matches(false);
  const Pose truth = {rotation_exp(Vec3(0.1, 0.2, -0.4)), Vec3(1, 2, 3)};
  PoseInformation information;
  for (const Matched& match : matches) information.add(truth.q * match.point, 1.0);
  const Mat6 inverse = dense::inverse(*information.covariance(false)) / (kNoise_m * kNoise_m);
  scenes::Random random(11);
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    Alignment alignment(truth);
    for (const Matched& match : matches)
      alignment.add(truth * match.point,
                    match.point + kNoise_m * Vec3(random.normal(), random.normal(), random.normal()), 1.0);
    Pose fitted;
    ASSERT_TRUE(alignment.solve({false, 1e-6}, fitted));
    Eigen::Matrix<double, 6, 1> error;
    error << truth.t - fitted.t, rotation_log(truth.q * fitted.q.conjugate());
    sum += error.dot(inverse * error);
  }
  // 95 % bounds of a chi-squared mean over 6 * kRuns degrees of freedom.
  EXPECT_NEAR(sum / (6.0 * kRuns), 1.0, 1.96 * std::sqrt(2.0 / (6.0 * kRuns)));
}

}  // namespace
}  // namespace hallway::slam_point
