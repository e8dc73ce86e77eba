// SPDX-License-Identifier: MIT
#include "eval/consistency.hpp"

#include <gtest/gtest.h>

namespace hallway::eval {
namespace {

TEST(Consistency, OfNothingIsNotKnown) {
  EXPECT_FALSE(Consistency().mean());
}

TEST(Consistency, AnErrorOfOneSigmaInEachDirectionGivesOne) {
  Consistency consistency;
  consistency.add(Eigen::Vector3d(2, 3, 0.5), Eigen::Vector3d(4, 9, 0.25).asDiagonal());
  EXPECT_NEAR(*consistency.mean(), 1.0, 1e-15);
}

TEST(Consistency, IsTheMeanPerDegreeOfFreedom) {
  Consistency consistency;
  consistency.add(Eigen::Vector2d(2, 0), Eigen::Matrix2d::Identity());               // 4 of 2
  consistency.add(Eigen::VectorXd::Zero(6), 7.0 * Eigen::MatrixXd::Identity(6, 6));  // 0 of 6
  EXPECT_NEAR(*consistency.mean(), 4.0 / 8.0, 1e-15);
  EXPECT_EQ(consistency.count(), 2u);
}

TEST(Consistency, CorrelationsCount) {
  Eigen::Matrix2d covariance;
  covariance << 1.0, 0.9, 0.9, 1.0;
  Consistency along;
  along.add(Eigen::Vector2d(1, 1), covariance);
  Consistency across;
  across.add(Eigen::Vector2d(1, -1), covariance);
  EXPECT_NEAR(*along.mean(), 1.0 / 1.9, 1e-14);
  EXPECT_NEAR(*across.mean(), 1.0 / 0.1, 1e-13);
}

TEST(Consistency, WhatCannotMoveIsLeftOut) {
  Consistency consistency;
  consistency.add(Eigen::Vector3d(2, 2, 0), Eigen::Vector3d(4, 4, 0).asDiagonal());
  EXPECT_NEAR(*consistency.mean(), 1.0, 1e-15);
  consistency.add(Eigen::Vector3d(2, 2, 0), Eigen::Matrix3d::Zero());
  EXPECT_EQ(consistency.count(), 1u);
}

TEST(Consistency, AMatrixThatIsNoCovarianceAddsNothing) {
  Consistency consistency;
  Eigen::Matrix2d covariance;
  covariance << 1.0, 2.0, 2.0, 1.0;
  consistency.add(Eigen::Vector2d(1, 1), covariance);
  EXPECT_FALSE(consistency.mean());
}

}  // namespace
}  // namespace hallway::eval
