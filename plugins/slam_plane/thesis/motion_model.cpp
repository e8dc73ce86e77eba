// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/motion_model.hpp"

#include <cmath>
#include <numbers>

namespace hallway::slam_plane::thesis {

MotionModel::MotionModel(int begin_after, double parallel_deg)
    : begin_after_(begin_after), least_sine_(std::sin(parallel_deg * std::numbers::pi / 180.0)) {}

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
