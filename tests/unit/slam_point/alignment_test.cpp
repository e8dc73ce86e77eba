// SPDX-License-Identifier: MIT
#include "slam_point/core/fit/alignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/fit/robust_fit.hpp"
#include "support/dense.hpp"

namespace hallway::slam_point {
namespace {

Vec3 random_vec(scenes::Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Rotation of the weighted least-squares alignment by singular value decomposition: the oracle.
Mat3 kabsch(const std::vector<Pair>& pairs) {
  double weight = 0.0;
  Vec3 mean_a = Vec3::Zero();
  Vec3 mean_b = Vec3::Zero();
  for (const Pair& pair : pairs) {
    weight += pair.weight;
    mean_a += pair.weight * pair.reference;
    mean_b += pair.weight * pair.point;
  }
  mean_a /= weight;
  mean_b /= weight;
  Mat3 cross = Mat3::Zero();
  for (const Pair& pair : pairs)
    cross += pair.weight * (pair.reference - mean_a) * (pair.point - mean_b).transpose();
  return dense::nearest_rotation(cross);
}

TEST(Alignment, AgreesWithSingularValueDecomposition) {
  scenes::Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Pose truth{rotation_exp(random_vec(random, 0.4)), random_vec(random, 500.0)};
    std::vector<Pair> pairs;
    for (int i = 0; i < 3 + trial % 20; ++i) {
      const Vec3 b = random_vec(random, 40.0);
      pairs.push_back({truth * b + random_vec(random, 0.3), b, random.uniform(0.1, 1.0)});
    }
    Alignment alignment(
        Pose{rotation_exp(random_vec(random, 0.1)) * truth.q, truth.t + random_vec(random, 1.0)});
    for (const Pair& pair : pairs) alignment.add(pair.reference, pair.point, pair.weight);
    Pose fitted;
    if (!alignment.solve({false, 1.0}, fitted)) continue;
    EXPECT_LT((fitted.q.toRotationMatrix() - kabsch(pairs)).norm(), 1e-9) << "trial " << trial;
  }
}

TEST(Alignment, RecoversAnExactPose) {
  scenes::Random random(2);
  const Pose truth{rotation_exp(Vec3(0.3, -0.2, 0.4)), Vec3(1000.0, -2000.0, 30.0)};
  Alignment alignment(Pose{Eigen::Quaterniond::Identity(), Vec3(1000.0, -2000.0, 29.0)});
  for (int i = 0; i < 10; ++i) {
    const Vec3 b = random_vec(random, 50.0);
    alignment.add(truth * b, b, 1.0);
  }
  Pose fitted;
  ASSERT_TRUE(alignment.solve({false, 1e-6}, fitted));
  EXPECT_LT((fitted.t - truth.t).norm(), 1e-10);
  EXPECT_LT(rotation_log(fitted.q * truth.q.conjugate()).norm(), 1e-13);
}

TEST(Alignment, CollinearPointsDoNotDetermineAPose) {
  Alignment alignment(Pose{});
  for (int i = 0; i < 10; ++i) alignment.add(Vec3(i, 2.0 * i, -i), Vec3(i, 2.0 * i, -i), 1.0);
  Pose fitted;
  EXPECT_FALSE(alignment.solve({false, 1e-6}, fitted));
}

TEST(Alignment, TwoPointsDetermineAPlanarPose) {
  const Pose truth{rotation_exp(Vec3(0.0, 0.0, 0.2)), Vec3(3.0, -1.0, 0.0)};
  Alignment alignment(Pose{});
  for (const Vec3& b : {Vec3(1.0, 0.0, 0.0), Vec3(7.0, 4.0, 0.0)}) alignment.add(truth * b, b, 1.0);
  Pose fitted;
  ASSERT_TRUE(alignment.solve({true, 1e-6}, fitted));
  EXPECT_LT((fitted.t - truth.t).norm(), 1e-12);
  EXPECT_EQ(fitted.t.z(), 0.0);
  EXPECT_EQ(fitted.q.x(), 0.0);
  EXPECT_EQ(fitted.q.y(), 0.0);
}

TEST(Alignment, OnePointAndNoPointDetermineNothing) {
  Pose fitted;
  EXPECT_FALSE(Alignment(Pose{}).solve({false, 1e-6}, fitted));
  Alignment one(Pose{});
  one.add(Vec3(1.0, 2.0, 0.0), Vec3(1.0, 2.0, 0.0), 1.0);
  EXPECT_FALSE(one.solve({true, 1e-6}, fitted));
  EXPECT_FALSE(one.solve({false, 1e-6}, fitted));
}

TEST(RobustFit, AThirdOfWildPairsHardlyMovesThePose) {
  scenes::Random random(3);
  std::vector<Pair> pairs;
  for (int i = 0; i < 30; ++i) {
    const Vec3 b = random_vec(random, 30.0);
    const Vec3 wild = i % 3 == 0 ? Vec3(2.0, 2.0, 0.0) : Vec3::Zero();
    pairs.push_back({b + wild, b, 1.0});
  }
  Pose plain;
  ASSERT_TRUE(robust_fit(pairs, {false, 1.0, 1e9}, plain));
  Pose robust;
  ASSERT_TRUE(robust_fit(pairs, {false, 1.0, 0.2}, robust));
  EXPECT_GT(plain.t.norm(), 0.5);
  EXPECT_LT(robust.t.norm(), 0.05);
}

/// As defined: the weights that residuals ask for and the pose that weights ask for, in turn, to the end.
Pose reweighted_to_the_end(const std::vector<Pair>& pairs, double inlier_m) {
  Pose T;
  for (int pass = 0; pass < 200; ++pass) {
    Alignment alignment(T);
    for (const Pair& pair : pairs) {
      const double r2 = (pair.reference - T * pair.point).squaredNorm();
      alignment.add(pair.reference, pair.point, pair.weight * std::min(1.0, inlier_m * inlier_m / r2));
    }
    EXPECT_TRUE(alignment.solve({false, 1.0}, T));
  }
  return T;
}

TEST(RobustFit, AFewOutliersCountAsTheLastWeightsHaveIt) {
  constexpr double kSigma_m = 0.05;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    scenes::Random random(seed);
    std::vector<Pair> pairs;
    for (int i = 0; i < 200; ++i) {
      const Vec3 b = random_vec(random, 30.0);
      const double noise = i % 20 == 0 ? 5.0 * kSigma_m : kSigma_m;
      pairs.push_back({b + noise * Vec3(random.normal(), random.normal(), random.normal()), b, 0.8});
    }
    Pose robust;
    ASSERT_TRUE(robust_fit(pairs, {false, 1.0, 4.0 * kSigma_m}, robust));
    const Pose expected = reweighted_to_the_end(pairs, 4.0 * kSigma_m);
    // The pose itself is known to 5 mm and 0.2 mrad.
    EXPECT_LT((robust.t - expected.t).norm(), 2e-5) << seed;
    EXPECT_LT(robust.q.angularDistance(expected.q), 1e-6) << seed;
  }
}

TEST(RotationExp, InvertsRotationLog) {
  scenes::Random random(4);
  for (int i = 0; i < 100; ++i) {
    const Vec3 v = random_vec(random, 1.7);
    EXPECT_LT((rotation_log(rotation_exp(v)) - v).norm(), 1e-12);
  }
  EXPECT_EQ(rotation_log(rotation_exp(Vec3::Zero())).norm(), 0.0);
}

}  // namespace
}  // namespace hallway::slam_point
