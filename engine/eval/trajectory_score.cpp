// SPDX-License-Identifier: MIT
#include "eval/trajectory_score.hpp"

#include <cmath>
#include <numbers>

#include "eval/point_error.hpp"
#include "geometry/rigid_fit.hpp"

namespace hallway::eval {
namespace {

double rotation_rmse(const std::vector<Quat>& truth, const std::vector<Quat>& estimate,
                     const Quat& q_world_map) {
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double angle = angle_between(truth[i], q_world_map * estimate[i]);
    sum += angle * angle;
  }
  return std::sqrt(sum / static_cast<double>(truth.size())) * 180.0 / std::numbers::pi;
}

}  // namespace

void TrajectoryScore::add(const Pose& T_world_body, const Pose& T_map_body,
                          const std::optional<Eigen::Matrix<double, 6, 6>>& covariance) {
  if (covariance) stated_.push_back({truth_.size(), *covariance});
  truth_.push_back(T_world_body.t);
  estimate_.push_back(T_map_body.t);
  truth_q_.push_back(T_world_body.q.normalized());
  estimate_q_.push_back(T_map_body.q.normalized());
}

void TrajectoryScore::add_position(const Vec3& true_position, const Pose& T_map_body) {
  add({Quat::Identity(), true_position}, T_map_body, std::nullopt);
  orientations_known_ = false;
}

std::optional<Pose> TrajectoryScore::first_pose_frame() const {
  if (truth_.empty() || !orientations_known_) return std::nullopt;
  return Pose{truth_q_[0], truth_[0]} * Pose{estimate_q_[0], estimate_[0]}.inverse();
}

AlignedRmse TrajectoryScore::position_rmse_m() const {
  AlignedRmse result;
  if (const auto T_world_map = first_pose_frame()) result.first_pose = rmse(truth_, estimate_, *T_world_map);
  result.aligned = aligned_rmse(truth_, estimate_);
  return result;
}

AlignedRmse TrajectoryScore::rotation_rmse_deg() const {
  const auto T_world_map = first_pose_frame();
  if (!T_world_map) return {};
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < truth_q_.size(); ++i) {
    sum += (truth_q_[i] * estimate_q_[i].conjugate()).toRotationMatrix();
  }
  return {rotation_rmse(truth_q_, estimate_q_, T_world_map->q),
          rotation_rmse(truth_q_, estimate_q_, nearest_rotation(sum))};
}

Consistency TrajectoryScore::consistency(const std::optional<Pose>& fit) const {
  Consistency consistency;
  if (truth_.size() < 3 || !orientations_known_) return consistency;
  const Pose T_map_world = fit ? *fit : *rigid_fit(truth_, estimate_);
  for (const Stated& stated : stated_) {
    const Eigen::AngleAxisd turn(T_map_world.q * truth_q_[stated.pair] *
                                 estimate_q_[stated.pair].conjugate());
    Eigen::Matrix<double, 6, 1> error;
    error << T_map_world * truth_[stated.pair] - estimate_[stated.pair], turn.angle() * turn.axis();
    consistency.add(error, stated.covariance);
  }
  return consistency;
}

std::optional<double> TrajectoryScore::position_final_m() const {
  const auto T_world_map = first_pose_frame();
  if (!T_world_map) return std::nullopt;
  return (*T_world_map * estimate_.back() - truth_.back()).norm();
}

}  // namespace hallway::eval
