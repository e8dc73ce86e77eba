// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/motion_prediction.hpp"

#include <gtest/gtest.h>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kMatchBound_m = 0.6;

void expect_same(const Pose& a, const Pose& b) {
  EXPECT_LT((a.t - b.t).norm(), 1e-12);
  EXPECT_LT(rotation_log(a.q * b.q.conjugate()).norm(), 1e-12);
}

Pose turned(double yaw, double x) {
  return scenes::heading(Vec3(x, 0, 0), yaw);
}

TEST(MotionPrediction, BeforeAnythingIsKnownTheSensorStands) {
  const Pose from{rotation_exp(Vec3(1, 2, -1)), Vec3(3, 4, 5)};
  expect_same(MotionPrediction(0.5, kMatchBound_m).after(from, 7), from);
}

TEST(MotionPrediction, TheLastMotionIsMadeAgain) {
  MotionPrediction prediction(0.5, kMatchBound_m);
  const Pose from{rotation_exp(Vec3(1, 2, -1)), Vec3(3, 4, 5)};
  const Pose moved{rotation_exp(Vec3(0.1, -0.05, 0.2)), Vec3(0.3, 0.1, -0.1)};
  prediction.learn(moved, 1, false);
  expect_same(prediction.after(from, 0), from);
  expect_same(prediction.after(from, 1), from * moved);
  expect_same(prediction.after(from, 3), from * moved * moved * moved);
}

TEST(MotionPrediction, NewMotionsAreSmoothedIntoTheOldOnesByTheirShare) {
  MotionPrediction prediction(0.25, kMatchBound_m);
  prediction.learn(turned(0.1, 1.0), 1, false);  // the first is taken as it is
  prediction.learn(turned(0.3, 2.0), 1, false);
  expect_same(prediction.after(Pose{}, 1), turned(0.15, 1.25));
  prediction.learn(turned(0.15, 0.25), 1, false);
  expect_same(prediction.after(Pose{}, 1), turned(0.15, 1.0));
}

TEST(MotionPrediction, AMotionOfSeveralFramesIsSharedAmongThem) {
  MotionPrediction prediction(0.5, kMatchBound_m);
  prediction.learn({rotation_exp(Vec3(0, 0, 0.6)), Vec3(3, 0.3, -0.6)}, 3, false);
  expect_same(prediction.after(Pose{}, 1), {rotation_exp(Vec3(0, 0, 0.2)), Vec3(1, 0.1, -0.2)});
}

TEST(MotionPrediction, ASuddenMotionTakesThePlaceOfThoseBefore) {
  MotionPrediction prediction(0.25, kMatchBound_m);
  prediction.learn(turned(0.1, 1.0), 1, false);
  prediction.learn(turned(-0.4, 0.2), 1, true);
  expect_same(prediction.after(Pose{}, 1), turned(-0.4, 0.2));
}

TEST(MotionPrediction, ToBeCarriedIsNoMotion) {
  MotionPrediction prediction(0.5, kMatchBound_m);
  prediction.learn(turned(0.1, 1.0), 1, false);
  prediction.learn(turned(0.1, 3.1), 1, true);  // more than five match bounds
  expect_same(prediction.after(Pose{}, 1), turned(0.1, 1.0));
  prediction.learn(turned(1.1, 1.0), 1, true);  // more than a radian
  expect_same(prediction.after(Pose{}, 1), turned(0.1, 1.0));
  prediction.learn(turned(1.1, 3.1), 2, true);  // in two frames it is a motion
  expect_same(prediction.after(Pose{}, 1), turned(0.55, 1.55));
  prediction.learn(turned(0.55, 4.65), 1, false);  // one that was followed is, however fast
  expect_same(prediction.after(Pose{}, 1), turned(0.55, 3.1));
}

}  // namespace
}  // namespace hallway::slam_point
