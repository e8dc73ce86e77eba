// SPDX-License-Identifier: MIT
#include "geometry/se3.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/geometry/random_geometry.hpp"

namespace hallway {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::uint32_t kCases = 500;

const test::RandomGeometry& geometry() {
  static const test::RandomGeometry instance(stream_id("pose"));
  return instance;
}

void expect_same(const Pose& a, const Pose& b) {
  EXPECT_LT((a.t - b.t).norm(), 1e-12);
  EXPECT_LT(angle_between(a.q, b.q), 1e-12);
}

TEST(Pose, ProductMapsAsOneAfterTheOther) {
  for (std::uint32_t i = 0; i < kCases; ++i) {
    const Pose a = geometry().pose(3 * i);
    const Pose b = geometry().pose(3 * i + 1);
    const Vec3 x = geometry().vector(3 * i + 2);
    EXPECT_LT(((a * b) * x - a * (b * x)).norm(), 1e-12);
  }
}

TEST(Pose, InverseUndoesOnBothSides) {
  for (std::uint32_t i = 0; i < kCases; ++i) {
    const Pose a = geometry().pose(i);
    expect_same(a * a.inverse(), Pose{});
    expect_same(a.inverse() * a, Pose{});
  }
}

TEST(Pose, ProductIsAssociative) {
  for (std::uint32_t i = 0; i < kCases; ++i) {
    const Pose a = geometry().pose(3 * i);
    const Pose b = geometry().pose(3 * i + 1);
    const Pose c = geometry().pose(3 * i + 2);
    expect_same((a * b) * c, a * (b * c));
  }
}

TEST(Pose, KeepsDistances) {
  for (std::uint32_t i = 0; i < kCases; ++i) {
    const Pose a = geometry().pose(3 * i);
    const Vec3 x = geometry().vector(3 * i + 1);
    const Vec3 y = geometry().vector(3 * i + 2);
    EXPECT_NEAR((a * x - a * y).norm(), (x - y).norm(), 1e-12);
  }
}

TEST(Pose, StaysAUnitQuaternionOverManyProducts) {
  Pose pose;
  for (std::uint32_t i = 0; i < 100'000; ++i) pose = pose * Pose{geometry().rotation(i % 100), Vec3::Zero()};
  EXPECT_NEAR(pose.q.norm(), 1.0, 1e-15);
}

TEST(LookAlong, PutsXForwardYLevelAndZUp) {
  for (std::uint32_t i = 0; i < kCases; ++i) {
    const Vec3 forward = geometry().vector(i);
    const Pose pose = look_along(Vec3(1, 2, 3), forward);
    EXPECT_LT((pose.q * Vec3::UnitX() - forward.normalized()).norm(), 1e-12);
    EXPECT_NEAR((pose.q * Vec3::UnitY()).z(), 0.0, 1e-12);
    EXPECT_GE((pose.q * Vec3::UnitZ()).z(), 0.0);
    EXPECT_EQ(pose.t, Vec3(1, 2, 3));
  }
}

TEST(LookAlong, TakesTheWorldsYWhereForwardIsVertical) {
  for (const double z : {2.0, -2.0}) {
    const Pose pose = look_along(Vec3::Zero(), Vec3(0, 0, z));
    EXPECT_LT((pose.q * Vec3::UnitX() - Vec3(0, 0, z / 2.0)).norm(), 1e-12);
    EXPECT_LT((pose.q * Vec3::UnitY() - Vec3::UnitY()).norm(), 1e-12);
  }
}

TEST(FromYawPitchRoll, TurnsAsDocumented) {
  const double quarter = kPi / 2.0;
  EXPECT_LT((from_yaw_pitch_roll(quarter, 0, 0) * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_LT((from_yaw_pitch_roll(0, quarter, 0) * Vec3::UnitX() + Vec3::UnitZ()).norm(),
            1e-12);  // looks down
  EXPECT_LT((from_yaw_pitch_roll(0, 0, quarter) * Vec3::UnitY() - Vec3::UnitZ()).norm(), 1e-12);
  // Yaw first: pitch is about the axis that yaw has turned.
  EXPECT_LT((from_yaw_pitch_roll(quarter, quarter, 0) * Vec3::UnitY() + Vec3::UnitX()).norm(), 1e-12);
}

TEST(RotationVector, IsUndoneByTheRotationThatItMakes) {
  for (std::uint32_t i = 0; i < kCases; ++i) {
    const Vec3 vector = geometry().vector(i).normalized() * (i % 2 == 0 ? 1e-13 : 0.006 * i);
    EXPECT_LT((rotation_vector(rotation_by(vector)) - vector).norm(), 1e-12);
    const Quat q = rotation_by(vector);
    EXPECT_LT((rotation_vector(Quat(-q.w(), -q.x(), -q.y(), -q.z())) - vector).norm(), 1e-12);
    EXPECT_NEAR(angle_of(q), vector.norm(), 1e-12);
  }
  EXPECT_EQ(rotation_by(Vec3::Zero()).coeffs(), Quat::Identity().coeffs());
}

TEST(AngleBetween, IsTheAngleOfTheTurn) {
  for (const double angle : {0.0, 1e-9, 1e-4, 1.0, 3.0, kPi}) {
    const Quat a = geometry().rotation(1);
    const Quat b = a * Quat(Eigen::AngleAxisd(angle, geometry().vector(2).normalized()));
    EXPECT_NEAR(angle_between(a, b), angle, 2e-15);
  }
}

TEST(AngleBetween, DoesNotSeeTheSignOfAQuaternion) {
  const Quat a = geometry().rotation(1);
  const Quat negated(-a.w(), -a.x(), -a.y(), -a.z());
  EXPECT_NEAR(angle_between(a, negated), 0.0, 1e-15);
}

TEST(AngleBetween, NeverExceedsHalfATurn) {
  for (std::uint32_t i = 0; i < kCases; ++i) {
    EXPECT_LE(angle_between(geometry().rotation(2 * i), geometry().rotation(2 * i + 1)), kPi);
  }
}

}  // namespace
}  // namespace hallway
