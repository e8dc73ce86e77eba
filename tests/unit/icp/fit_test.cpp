// SPDX-License-Identifier: MIT
#include "icp/core/fit.hpp"

#include <gtest/gtest.h>

#include "clouds.hpp"
#include "icp/core/robust.hpp"

namespace hallway::icp {
namespace {

using clouds::gap;
using clouds::Random;

std::vector<Pair> pairs_of(const Points& points, const Pose& motion) {
  std::vector<Pair> pairs;
  for (const Vec3& p : points) pairs.push_back({motion * p, Vec3::Zero(), p, 1.0});
  return pairs;
}

double cost(const std::vector<Pair>& pairs, const Pose& motion) {
  double sum = 0.0;
  for (const Pair& pair : pairs) sum += pair.weight * (pair.target - motion * pair.moved).squaredNorm();
  return sum;
}

TEST(FitPoints, FindsAnyMotion) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Pose motion = clouds::pose(random.in_box({50, 50, 50}), random.uniform(-3, 3),
                                     random.uniform(-1.5, 1.5), random.uniform(-3, 3));
    const auto fitted = fit_points(
        pairs_of(clouds::scattered(i % 2 == 0 ? 3 : 30, 100 + static_cast<std::uint64_t>(i)), motion));
    ASSERT_TRUE(fitted);
    EXPECT_LT(gap(*fitted, motion), 1e-9);
  }
}

TEST(FitPoints, APlaneOfPointsIsNotMirrored) {
  const Pose motion = clouds::pose({1, 2, 3}, 2.0, 0.5, -1.0);
  Points flat = clouds::scattered(20, 2);
  for (Vec3& p : flat) p.z() = 0.0;
  const auto fitted = fit_points(pairs_of(flat, motion));
  ASSERT_TRUE(fitted);
  EXPECT_LT(gap(*fitted, motion), 1e-9);
}

TEST(FitPoints, NoMotionNearbyFitsBetter) {
  Random random(3);
  std::vector<Pair> pairs = pairs_of(clouds::scattered(40, 4), clouds::pose({1, 0, -1}, 0.4));
  for (Pair& pair : pairs) {
    pair.target += random.noise(0.3);
    pair.weight = random.uniform(0.0, 2.0);
  }
  const Pose fitted = *fit_points(pairs);
  for (int i = 0; i < 100; ++i) {
    const Vec3 turn = random.noise(1e-3);
    const Pose nudge = clouds::pose(random.noise(1e-3), turn.x(), turn.y(), turn.z());
    EXPECT_GE(cost(pairs, nudge * fitted), cost(pairs, fitted));
  }
}

TEST(FitPoints, LinesAndSinglePlacesLeaveItOpen) {
  Points line;
  for (int i = 0; i < 10; ++i) line.push_back(Vec3(i, 2 * i, 0.1 * i));
  EXPECT_FALSE(fit_points(pairs_of(line, clouds::pose({1, 2, 3}, 0.5))));
  EXPECT_FALSE(fit_points(pairs_of(Points(5, Vec3(1, 1, 1)), Pose())));
  EXPECT_FALSE(fit_points({}));
  std::vector<Pair> weightless = pairs_of(clouds::scattered(10, 5), Pose());
  for (Pair& pair : weightless) pair.weight = 0.0;
  EXPECT_FALSE(fit_points(weightless));
}

std::vector<Pair> plane_pairs(const Points& normals, const Pose& motion) {
  const Points places = clouds::scattered(normals.size(), 6);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    // Any place on the target's plane will do for a match.
    const Vec3 along = normals[i].unitOrthogonal();
    pairs.push_back({motion * places[i] + 0.3 * along, normals[i], places[i], 1.0});
  }
  return pairs;
}

TEST(FitPlanes, ASmallMotionIsFoundToSecondOrder) {
  Random random(7);
  Points normals;
  for (int i = 0; i < 40; ++i) normals.push_back(random.in_box({1, 1, 1}).normalized());
  for (const double size : {1e-2, 1e-3, 1e-4}) {
    const Pose motion = clouds::pose(Vec3(1, -0.5, 0.7) * size, size, -0.6 * size, 0.3 * size);
    const auto fitted = fit_planes(plane_pairs(normals, motion));
    ASSERT_TRUE(fitted);
    EXPECT_LT(gap(*fitted, motion), 100.0 * size * size);
  }
}

TEST(FitPlanes, OnePlaneAndAPlainCorridorLeaveItOpen) {
  EXPECT_FALSE(fit_planes(plane_pairs(Points(30, Vec3::UnitZ()), Pose())));
  Points corridor;
  for (int i = 0; i < 30; ++i) corridor.push_back(i % 2 == 0 ? Vec3::UnitZ() : Vec3::UnitY());
  EXPECT_FALSE(fit_planes(plane_pairs(corridor, Pose())));
  EXPECT_FALSE(fit_planes({}));
}

TEST(Robust, WeightsFallWithTheResidual) {
  for (const Kernel kernel : {Kernel::huber, Kernel::cauchy, Kernel::tukey}) {
    double last = 1.0;
    for (double r = 0.0; r < 10.0; r += 0.1) {
      const double weight = weight_of(kernel, r, 1.0);
      EXPECT_LE(weight, last);
      EXPECT_GE(weight, 0.0);
      EXPECT_DOUBLE_EQ(weight, weight_of(kernel, 4.0 * r, 4.0));
      last = weight;
    }
    EXPECT_LT(last, 0.2);
  }
  EXPECT_EQ(weight_of(Kernel::tukey, 4.7, 1.0), 0.0);
  EXPECT_EQ(weight_of(Kernel::huber, 1.3, 1.0), 1.0);
  EXPECT_EQ(weight_of(Kernel::none, 1e6, 1.0), 1.0);
}

TEST(Robust, ScaleIsThatOfTheMostWhateverTheRest) {
  Random random(8);
  std::vector<double> residuals;
  for (int i = 0; i < 2000; ++i) residuals.push_back(std::abs(0.2 * random.normal()));
  EXPECT_NEAR(scale_of(residuals), 0.2, 0.02);
  for (int i = 0; i < 500; ++i) residuals.push_back(1e3);
  EXPECT_LT(scale_of(residuals), 0.3);
  EXPECT_EQ(scale_of({}), 0.0);
  EXPECT_EQ(weight_of(Kernel::tukey, 0.0, 0.0), 1.0);
  EXPECT_EQ(weight_of(Kernel::tukey, 1e-9, 0.0), 0.0);
}

}  // namespace
}  // namespace hallway::icp
