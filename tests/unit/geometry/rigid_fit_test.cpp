// SPDX-License-Identifier: MIT
#include "geometry/rigid_fit.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "unit/geometry/random_geometry.hpp"

namespace hallway {
namespace {

const test::RandomGeometry& geometry() {
  static const test::RandomGeometry instance(stream_id("fit"));
  return instance;
}

std::vector<Vec3> moved(const std::vector<Vec3>& points, const Pose& motion) {
  std::vector<Vec3> result;
  for (const Vec3& point : points) result.push_back(motion * point);
  return result;
}

double sum_of_squares(const Pose& fit, const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double sum = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) sum += (fit * from[i] - to[i]).squaredNorm();
  return sum;
}

void expect_rotation(const Pose& fit) {
  EXPECT_NEAR(fit.q.norm(), 1.0, 1e-14);
  EXPECT_NEAR(fit.q.toRotationMatrix().determinant(), 1.0, 1e-12);
}

TEST(RigidFit, FindsTheMotionOfPointsThatMoved) {
  for (std::uint32_t i = 0; i < 200; ++i) {
    const std::vector<Vec3> from = geometry().points(3 + i % 20, 1000 * i);
    const Pose motion = geometry().pose(1000 * i + 500);
    const auto fit = rigid_fit(from, moved(from, motion));
    ASSERT_TRUE(fit.has_value());
    EXPECT_LT((fit->t - motion.t).norm(), 1e-9);
    EXPECT_LT(angle_between(fit->q, motion.q), 1e-9);
  }
}

TEST(RigidFit, IsALeastSumOfSquares) {
  // No motion a little beside the fit is better, for points that do not fit exactly.
  for (std::uint32_t i = 0; i < 100; ++i) {
    const std::vector<Vec3> from = geometry().points(8, 100 * i);
    std::vector<Vec3> to = moved(from, geometry().pose(100 * i + 50));
    for (std::uint32_t k = 0; k < to.size(); ++k) to[k] += geometry().vector(100 * i + 60 + k, 0.5);
    const Pose fit = rigid_fit(from, to).value();
    const double least = sum_of_squares(fit, from, to);
    for (std::uint32_t k = 0; k < 20; ++k) {
      const Vec3 turn = geometry().vector(100 * i + 70 + k, 0.01);
      const Pose nudge{Quat(Eigen::AngleAxisd(turn.norm(), turn.normalized())),
                       geometry().vector(90 + k, 0.01)};
      EXPECT_GT(sum_of_squares(fit * nudge, from, to), least);
    }
  }
}

TEST(RigidFit, NeverMirrors) {
  const std::vector<Vec3> from = geometry().points(10, 0);
  std::vector<Vec3> mirrored = from;
  for (Vec3& point : mirrored) point.x() = -point.x();
  const auto fit = rigid_fit(from, mirrored);
  ASSERT_TRUE(fit.has_value());
  expect_rotation(*fit);
  EXPECT_GT(sum_of_squares(*fit, from, mirrored), 1.0);  // it cannot fit
}

TEST(RigidFit, FitsPointsOfOnePlane) {
  std::vector<Vec3> from = geometry().points(6, 0);
  for (Vec3& point : from) point.z() = 0.0;
  const Pose motion = geometry().pose(50);
  const auto fit = rigid_fit(from, moved(from, motion));
  ASSERT_TRUE(fit.has_value());
  EXPECT_LT(angle_between(fit->q, motion.q), 1e-9);
  EXPECT_LT((fit->t - motion.t).norm(), 1e-9);
}

TEST(RigidFit, BringsCollinearPointsTogether) {
  std::vector<Vec3> from;
  for (int i = 0; i < 5; ++i) from.push_back(Vec3(1, 2, 3) + i * Vec3(0.3, -0.2, 0.9));
  const std::vector<Vec3> to = moved(from, geometry().pose(50));
  const auto fit = rigid_fit(from, to);
  ASSERT_TRUE(fit.has_value());
  expect_rotation(*fit);
  EXPECT_LT(sum_of_squares(*fit, from, to), 1e-20);
}

TEST(RigidFit, GivesTheSameAnswerTwiceWhereItIsOpen) {
  const std::vector<Vec3> from{Vec3(0, 0, 0), Vec3(1, 0, 0)};
  const std::vector<Vec3> to{Vec3(5, 5, 5), Vec3(5, 6, 5)};
  const Pose once = rigid_fit(from, to).value();
  const Pose again = rigid_fit(from, to).value();
  EXPECT_EQ(once.q.coeffs(), again.q.coeffs());
  EXPECT_EQ(once.t, again.t);
}

TEST(RigidFit, BringsTwoPointsTogether) {
  const std::vector<Vec3> from{Vec3(0, 0, 0), Vec3(1, 0, 0)};
  const std::vector<Vec3> to{Vec3(5, 5, 5), Vec3(5, 6, 5)};
  const Pose fit = rigid_fit(from, to).value();
  expect_rotation(fit);
  EXPECT_LT(sum_of_squares(fit, from, to), 1e-24);
}

TEST(RigidFit, BringsOnePointToTheOther) {
  const std::vector<Vec3> from{Vec3(1, 2, 3)};
  const std::vector<Vec3> to{Vec3(-4, 5, 6)};
  const Pose fit = rigid_fit(from, to).value();
  expect_rotation(fit);
  EXPECT_LT((fit * from[0] - to[0]).norm(), 1e-14);
}

TEST(RigidFit, BringsCoincidentPointsTogether) {
  const std::vector<Vec3> from(4, Vec3(1, 2, 3));
  const std::vector<Vec3> to(4, Vec3(7, 8, 9));
  const Pose fit = rigid_fit(from, to).value();
  expect_rotation(fit);
  EXPECT_LT(sum_of_squares(fit, from, to), 1e-24);
}

TEST(RigidFit, IsEmptyForNoPoints) {
  EXPECT_FALSE(rigid_fit({}, {}).has_value());
}

TEST(RigidFit, RefusesSpansOfDifferentLength) {
  const std::vector<Vec3> one{Vec3::Zero()};
  EXPECT_THROW(rigid_fit(one, {}), std::invalid_argument);
  EXPECT_THROW(rigid_fit(one, one, {}), std::invalid_argument);
}

TEST(RigidFit, HoldsFarFromTheOrigin) {
  std::vector<Vec3> from = geometry().points(10, 0);
  for (Vec3& point : from) point += Vec3(1e6, -1e6, 1e5);
  const Pose motion = geometry().pose(50);
  const Pose fit = rigid_fit(from, moved(from, motion)).value();
  EXPECT_LT(angle_between(fit.q, motion.q), 1e-9);
}

}  // namespace
}  // namespace hallway
