// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/motion_prediction.hpp"

#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kMostTravelBounds = 5.0;  // match bounds of travel a frame that are taken for motion
constexpr double kMostTurn_rad = 1.0;      // likewise

}  // namespace

Pose MotionPrediction::after(const Pose& from, int frames) const {
  Pose pose = from;
  for (int f = 0; f < frames; ++f) pose = pose * Pose{rotation_exp(turn_), travel_};
  return pose;
}

void MotionPrediction::learn(const Pose& moved, int frames, bool sudden) {
  const Vec3 turn = rotation_log(moved.q) / static_cast<double>(frames);
  const Vec3 travel = moved.t / static_cast<double>(frames);
  const bool carried = travel.norm() > kMostTravelBounds * match_bound_ || turn.norm() > kMostTurn_rad;
  if (sudden && carried) return;
  const double share = has_motion_ && !sudden ? smoothing_ : 1.0;
  turn_ += share * (turn - turn_);
  travel_ += share * (travel - travel_);
  has_motion_ = true;
}

}  // namespace hallway::slam_point
