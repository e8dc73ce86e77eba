// SPDX-License-Identifier: MIT
#include "geometry/symmetric.hpp"

#include <gtest/gtest.h>

#include "unit/geometry/random_geometry.hpp"

namespace hallway {
namespace {

using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Symmetric, and positive definite unless fewer than six rows are asked for.
Mat6 random_matrix(std::uint32_t seed, std::uint32_t rows) {
  static const test::RandomGeometry geometry(stream_id("symmetric"));
  const std::vector<Vec3> points = geometry.points(2 * rows, 100 * seed);
  Mat6 sum = Mat6::Zero();
  for (std::uint32_t i = 0; i < rows; ++i) {
    Eigen::Matrix<double, 6, 1> row;
    row << points[2 * i], points[2 * i + 1];
    sum += row * row.transpose();
  }
  return sum;
}

TEST(Symmetric, TheSpectrumMakesTheMatrixAgain) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const Mat6 matrix = random_matrix(seed, 8);
    const Spectrum<6> found = spectrum<6>(matrix);
    EXPECT_LT((found.vectors * found.values.asDiagonal() * found.vectors.transpose() - matrix).norm(),
              1e-12 * matrix.norm());
    EXPECT_LT((found.vectors.transpose() * found.vectors - Mat6::Identity()).norm(), 1e-13);
    for (int k = 1; k < 6; ++k) EXPECT_LE(found.values(k - 1), found.values(k));
  }
}

TEST(Symmetric, SpectraThatAreKnown) {
  Eigen::Matrix2d two;
  two << 2, 1, 1, 2;
  EXPECT_TRUE(spectrum<2>(two).values.isApprox(Eigen::Vector2d(1, 3), 1e-15));
  Eigen::Matrix3d three = Eigen::Vector3d(5, -2, 0).asDiagonal();
  EXPECT_EQ(spectrum<3>(three).values, Eigen::Vector3d(-2, 0, 5));
  EXPECT_EQ(spectrum<3>(three).vectors.cwiseAbs().col(0), Eigen::Vector3d::UnitY());
}

TEST(Symmetric, OnlyTheLowerTriangleIsRead) {
  Eigen::Matrix2d matrix;
  matrix << 2, 99, 1, 2;
  EXPECT_TRUE(spectrum<2>(matrix).values.isApprox(Eigen::Vector2d(1, 3), 1e-15));
}

TEST(Symmetric, TheInverseTimesTheMatrixIsOne) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const Mat6 matrix = random_matrix(seed, 12);
    EXPECT_LT((Ldlt<6>(matrix).inverse() * matrix - Mat6::Identity()).norm(), 1e-6);
    const Eigen::Matrix3d part = matrix.topLeftCorner<3, 3>();
    EXPECT_LT((Ldlt<3>(part).inverse() * part - Eigen::Matrix3d::Identity()).norm(), 1e-6);
  }
}

TEST(Symmetric, WhatIsOpenIsNotMoved) {
  const Mat6 none = Mat6::Zero();
  EXPECT_EQ(Ldlt<6>(none).inverse(), none);
}

}  // namespace
}  // namespace hallway
