// SPDX-License-Identifier: MIT
#include "slam_plane/core/dead_reckoning.hpp"

#include <Eigen/LU>
#include <cmath>

namespace hallway::slam_plane {
namespace {

constexpr double kStepChange = 0.05;   // of the fastest step, from frame to frame (standard deviation)
constexpr double kSlip = 0.02;         // of a step, that it goes otherwise than where the robot looks
constexpr double kLeastStep_m = 1e-4;  // added to both
constexpr double kFirstStep_m = 0.1;   // standard deviation of a step of which nothing is known
constexpr double kMostSigmas2 = 25.0;  // of an answer, squared
constexpr double kUnmeasured_m2 = 1e4;

/// Covariance of the place by a frame alone; large in the direction that it leaves open.
Mat2 measured(const PoseInformation& information) {
  Mat2 place = information.position();
  if (information.open > 0) {
    const Vec2 other = left_of(information.direction);
    place = information.open == 2 ? Mat2(Mat2::Zero())
                                  : Mat2(other.dot(place * other) * other * other.transpose());
  }
  return (place + Mat2::Identity() / kUnmeasured_m2).inverse();
}

}  // namespace

void DeadReckoning::predict(const Pose2& T_map_submap, const Vec2& r, double fastest) {
  if (!running_) return;
  const Vec2 half_way = (T_map_submap.rotate(kept_.r) + r).normalized();
  const double step = state_(2);
  state_.head<2>() = T_map_submap * kept_.t + step * half_way;
  Mat3 F = Mat3::Identity();
  F.topRightCorner<2, 1>() = half_way;
  covariance_ = F * covariance_ * F.transpose();
  const double slip = kSlip * std::abs(step) + kLeastStep_m, change = kStepChange * fastest + kLeastStep_m;
  covariance_.diagonal() += Vec3(slip * slip, slip * slip, change * change);
}

void DeadReckoning::correct(const Pose2& T_map_robot, const PoseInformation& information) {
  const Mat2 own = measured(information);
  if (running_) {
    const Mat2 sum = covariance_.topLeftCorner<2, 2>() + own;
    const Mat2 inverse = sum.inverse();
    const Vec2 off = T_map_robot.t - state_.head<2>();
    if (off.dot(inverse * off) <= kMostSigmas2) {
      const Eigen::Matrix<double, 3, 2> gain = covariance_.leftCols<2>() * inverse;
      state_ += gain * off;
      covariance_ -= Mat3(gain * covariance_.topRows<2>());
      covariance_ = 0.5 * Mat3(covariance_ + covariance_.transpose());
      return;
    }
  }
  running_ = information.determined();
  state_ << T_map_robot.t, 0.0;
  covariance_.setZero();
  covariance_.topLeftCorner<2, 2>() = own;
  covariance_(2, 2) = kFirstStep_m * kFirstStep_m;
}

void DeadReckoning::keep(const Pose2& T_map_submap, const Pose2& T_map_robot) {
  kept_ = T_map_submap.inverse() * Pose2{state_.head<2>(), T_map_robot.r};
}

}  // namespace hallway::slam_plane
