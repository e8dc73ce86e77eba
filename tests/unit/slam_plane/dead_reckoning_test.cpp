// SPDX-License-Identifier: MIT
#include "slam_plane/core/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"

namespace hallway::slam_plane::test {
namespace {

constexpr double kStep_m = 0.04;

PoseInformation report_map(double sigma_x, double sigma_y) {
  PoseInformation information;
  information.matrix.diagonal() = Vec3(1.0 / (sigma_x * sigma_x), 1.0 / (sigma_y * sigma_y), 1e5);
  information.open = 0;
  information.heading = true;
  return information;
}

/// Along x nothing but rounding is told, y is.
PoseInformation open_x(double sigma_y) {
  PoseInformation information = report_map(1e3, sigma_y);
  information.open = 1;
  information.direction = Vec2(1, 0);
  return information;
}

/// A robot on a way, and where the filter has it.
struct Way {
  DeadReckoning reckoning;
  Pose2 truth;

  void go(double turn_rad) {
    const Pose2 half = truth.moved(Vec2::Zero(), 0.5 * turn_rad);
    truth = truth.moved(half.rotate(Vec2(kStep_m, 0)), turn_rad);
    reckoning.predict(Pose2{}, truth.r, kStep_m);
  }
  void answer(const Vec2& off, const PoseInformation& information) {
    Pose2 T = truth;
    T.t += off;
    reckoning.correct(T, information);
    reckoning.keep(Pose2{}, T);
  }
};

TEST(DeadReckoning, KnowsTheWayRoundABendWithoutNoise) {
  Way way;
  way.answer(Vec2::Zero(), report_map(1e-3, 1e-3));
  for (int i = 0; i < 40; ++i) {
    way.go(0.0);
    way.answer(Vec2::Zero(), report_map(1e-3, 1e-3));
  }
  for (int i = 0; i < 30; ++i) {  // a bend of half a turn: x is told by the step alone
    way.go(0.1);
    EXPECT_NEAR((way.reckoning.place() - way.truth.t).norm(), 0.0, 1e-4);
    Pose2 T = way.truth;
    T.t.x() = way.reckoning.place().x();
    way.answer(T.t - way.truth.t, open_x(1e-3));
  }
}

TEST(DeadReckoning, GoesOnFromAllFramesAndNotFromTheLast) {
  // The last frames before nothing tells the place along y are good to 5 cm each; the way on begins within 2.
  const Random random(7, stream_id("test.dead_reckoning"));
  double sum2 = 0.0;
  for (std::uint32_t run = 0; run < 50; ++run) {
    Way way;
    way.answer(Vec2::Zero(), report_map(0.01, 0.01));
    for (std::uint32_t i = 0; i < 60; ++i) {
      way.go(0.0);
      const double sigma = i < 50 ? 0.01 : 0.05;
      way.answer(Vec2(0.01 * random.normal(run, 2 * i), sigma * random.normal(run, 2 * i + 1)),
                 report_map(0.01, sigma));
    }
    for (int i = 0; i < 50; ++i) {
      way.go(0.0);
      PoseInformation information = report_map(0.02, 1e3);
      information.open = 1;
      information.direction = Vec2(0, 1);
      way.answer(Vec2(0, way.reckoning.place().y() - way.truth.t.y()), information);
    }
    sum2 += std::pow(way.reckoning.place().y() - way.truth.t.y(), 2);
  }
  EXPECT_LT(std::sqrt(sum2 / 50), 0.02);
}

TEST(DeadReckoning, BeginsAnewWhereFramesContradict) {
  Way way;
  way.answer(Vec2::Zero(), report_map(0.01, 0.01));
  for (int i = 0; i < 40; ++i) {
    way.go(0.0);
    way.answer(Vec2::Zero(), report_map(0.01, 0.01));
  }
  way.go(0.0);
  way.answer(Vec2(1.0, 0.5), report_map(0.01, 0.01));  // carried
  EXPECT_NEAR((way.reckoning.place() - way.truth.t - Vec2(1.0, 0.5)).norm(), 0.0, 1e-9);
}

TEST(DeadReckoning, MovesWithItsSubmap) {
  DeadReckoning reckoning;
  reckoning.correct(Pose2::at({1, 2}, 0.3), report_map(0.01, 0.01));
  reckoning.keep(Pose2::at({0.5, 0}, 0.1), Pose2::at({1, 2}, 0.3));
  const Pose2 moved = Pose2::at({0.2, -0.1}, 0.05) * Pose2::at({0.5, 0}, 0.1);
  reckoning.predict(moved, Vec2(1, 0), kStep_m);
  EXPECT_NEAR((reckoning.place() - Pose2::at({0.2, -0.1}, 0.05) * Vec2(1, 2)).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace hallway::slam_plane::test
