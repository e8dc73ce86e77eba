// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/motion_model.hpp"

#include <cmath>
#include <numbers>

namespace hallway::slam_plane::thesis {

namespace {

constexpr double kAgree = 4.0;  // standard deviations by which two means may differ

}  // namespace

double StepLength::mean() const {
  const std::size_t size = steps_.size();
  double distance = 0.0, share = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    distance += steps_[i].distance;
    share += steps_[i].share;
  }
  if (size < 3) return size > 0 ? distance / share : 0.0;
  double roughness = 0.0;
  for (std::size_t i = 1; i < size; ++i) {
    const double change = steps_[i].distance - steps_[i - 1].distance -
                          distance / share * (steps_[i].share - steps_[i - 1].share);
    roughness += change * change;
  }
  // A change of the step holds the noise of three places with the weights 1, -2 and 1, a mean that of its first and last one.
  const double deviation = std::sqrt(2.0 * roughness / (6.0 * static_cast<double>(size - 1)));
  double newer_distance = 0.0, newer_share = 0.0, result = distance / share, most = kAgree * deviation;
  for (std::size_t i = size - 1; i > 0; --i) {
    newer_distance += steps_[i].distance;
    newer_share += steps_[i].share;
    const double older_share = share - newer_share;
    const double newer = newer_distance / newer_share;
    const double differs = std::abs(newer - (distance - newer_distance) / older_share);
    const double significance = differs / (1.0 / newer_share + 1.0 / older_share);
    if (significance <= most) continue;
    most = significance;
    result = newer;
  }
  return result;
}

MotionModel::MotionModel(int begin_after, double parallel_deg)
    : begin_after_(begin_after), least_sine_(std::sin(radians(parallel_deg))) {}

Pose2 MotionModel::predicted() const {
  return has_step_ ? pose_ * step_ : pose_;
}

void MotionModel::moved_to(const Pose2& T_map_robot) {
  if (has_pose_) {
    step_ = pose_.inverse() * T_map_robot;
    has_step_ = true;
  }
  pose_ = T_map_robot;
  has_pose_ = true;
}

bool MotionModel::coast() {
  ++unknown_;
  if (!has_step_ || coasted_ >= kCoast) return false;
  ++coasted_;
  moved_to(predicted());
  return true;
}

void MotionModel::known(const Pose2& T_map_robot) {
  const bool follows = has_pose_ && unknown_ == 0;
  unknown_ = coasted_ = 0;
  if (!follows) has_pose_ = false;  // where it was is no longer what it was measured from
  moved_to(T_map_robot);
  if (follows) steps_.add(step_.t.x(), 1.0);
}

Pose2 MotionModel::restricted(const Alignment& alignment) {
  ++unknown_;
  coasted_ = 0;
  Pose2 result = alignment.T_to_from;
  const Vec2 along = alignment.open;
  const Vec2 across = left_of(along);
  const Vec2 forward = (pose_.r + result.r).normalized();  // of an arc: the direction of its chord
  const double sine = across.dot(forward);
  const double distance = across.dot(result.t - pose_.t);
  const bool measured = std::abs(sine) > least_sine_;
  if (measured) steps_.add(sine > 0.0 ? distance : -distance, std::abs(sine));
  const double travelled = (measured ? distance / sine : steps_.mean()) * along.dot(forward);
  result.t += along * (along.dot(pose_.t) + travelled - along.dot(result.t));
  moved_to(result);
  return result;
}

std::optional<Alignment> MotionModel::completed(std::optional<Alignment> told) {
  if (!told) {
    if (coast()) told = Alignment{pose_, false, pose_.r, false};
  } else if (told->determined) {
    known(told->T_to_from);
  } else {
    told->T_to_from = restricted(*told);
  }
  return told;
}

}  // namespace hallway::slam_plane::thesis
