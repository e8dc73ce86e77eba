// SPDX-License-Identifier: MIT
#include "em/core/plane_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "patches.hpp"
#include "support/dense.hpp"

namespace hallway::em {
namespace {

Moments moments_of(const std::vector<Vec3>& points) {
  Moments moments;
  for (const Vec3& p : points) moments.add(p);
  return moments;
}

// The oracle: singular values and vectors of the centred points themselves.
dense::Singular svd_of(const std::vector<Vec3>& points, Vec3& centroid) {
  centroid = Vec3::Zero();
  for (const Vec3& p : points) centroid += p / static_cast<double>(points.size());
  Eigen::MatrixXd centred(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    centred.row(static_cast<Eigen::Index>(i)) = (points[i] - centroid).transpose();
  }
  return dense::singular_of(centred);
}

TEST(PlaneFit, AgreesWithTheSingularValuesOfThePoints) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const std::vector<Vec3> points = planted::cloud_of(planted::random_patch(seed), seed);
    const auto fit = fit_plane(moments_of(points));
    ASSERT_TRUE(fit.has_value()) << seed;
    Vec3 centroid;
    const auto svd = svd_of(points, centroid);
    const double n = static_cast<double>(points.size());
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double variance = svd.values[2 - i] * svd.values[2 - i] / n;
      EXPECT_NEAR(fit->variances[i], variance, 1e-12) << seed;
    }
    EXPECT_NEAR(std::abs(fit->normal.dot(Vec3(svd.right.col(2)))), 1.0, 1e-12) << seed;
    EXPECT_NEAR((fit->centroid - centroid).norm(), 0.0, 1e-12) << seed;
    EXPECT_NEAR(fit->distance(centroid), 0.0, 1e-12) << seed;
  }
}

TEST(PlaneFit, NoOtherPlaneIsNearerToThePoints) {
  const std::vector<Vec3> points = planted::cloud_of(planted::random_patch(3), 3);
  const auto fit = fit_plane(moments_of(points));
  ASSERT_TRUE(fit.has_value());
  const auto cost = [&](const Vec3& normal, double offset) {
    double sum = 0.0;
    for (const Vec3& p : points) sum += std::pow(normal.dot(p) - offset, 2);
    return sum;
  };
  const double best = cost(fit->normal, fit->offset);
  EXPECT_NEAR(std::sqrt(best / static_cast<double>(points.size())), fit->rms(), 1e-9);
  for (const Vec3& tilt : {Vec3(1e-3, 0, 0), Vec3(0, 1e-3, 0), Vec3(0, 0, 1e-3)}) {
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 normal = (fit->normal + sign * tilt).normalized();
      EXPECT_GE(cost(normal, normal.dot(fit->centroid)), best);
      EXPECT_GT(cost(fit->normal, fit->offset + sign * 1e-3), best);
    }
  }
}

TEST(PlaneFit, PointsComeAndGoAndSumsJoin) {
  const std::vector<Vec3> points = planted::cloud_of(planted::random_patch(5), 5);
  const std::vector<Vec3> first(points.begin(), points.begin() + 100);
  const std::vector<Vec3> rest(points.begin() + 100, points.end());
  Moments joined = moments_of(first);
  joined.join(moments_of(rest));
  const auto whole = fit_plane(moments_of(points));
  const auto sum = fit_plane(joined);
  for (std::size_t i = 50; i < points.size(); ++i) joined.add(points[i], -1.0);
  const auto left = fit_plane(joined);
  const auto alone = fit_plane(moments_of({points.begin(), points.begin() + 50}));
  ASSERT_TRUE(whole && sum && left && alone);
  EXPECT_NEAR(std::abs(whole->normal.dot(sum->normal)), 1.0, 1e-12);
  EXPECT_NEAR(std::abs(left->normal.dot(alone->normal)), 1.0, 1e-10);
  EXPECT_NEAR(left->rms(), alone->rms(), 1e-9);
}

TEST(PlaneFit, WhatDefinesNoPlaneGivesNone) {
  EXPECT_FALSE(fit_plane(Moments()).has_value());
  EXPECT_FALSE(fit_plane(moments_of({{1, 2, 3}, {4, 5, 7}})).has_value());
  EXPECT_FALSE(fit_plane(moments_of(std::vector<Vec3>(50, Vec3(0.1, 7.3, -2.9)))).has_value());
  std::vector<Vec3> line;
  for (int i = 0; i < 50; ++i) line.emplace_back(Vec3(0.3, -1.7, 0.9) + 0.1 * i * Vec3(0.1, 0.7, 0.3));
  EXPECT_FALSE(fit_plane(moments_of(line)).has_value());
  EXPECT_FALSE(fit_plane(moments_of({{0, 0, 0}, {1, 0, 0}, {0, 1, std::nan("")}})).has_value());
  EXPECT_FALSE(fit_plane(moments_of({{0, 0, 0}, {1e200, 0, 0}, {0, 1e200, 0}})).has_value());
}

TEST(PlaneFit, ThreePointsAreTheirPlane) {
  const auto fit = fit_plane(moments_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(std::abs(fit->normal.dot(Vec3::Ones().normalized())), 1.0, 1e-12);
  EXPECT_LT(fit->rms(), 1e-7);
}

}  // namespace
}  // namespace hallway::em
