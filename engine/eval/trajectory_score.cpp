// SPDX-License-Identifier: MIT
#include "eval/trajectory_score.hpp"

#include <cmath>
#include <numbers>

#include "geometry/rigid_fit.hpp"

namespace hallway::eval {

Sequence<PointPair> TrajectoryScore::positions() const {
  return transformed(pairs_, [](const PosePair& pair) {
    return PointPair{pair.T_world_body.t, pair.T_map_body.t};
  });
}

Sequence<PosePair> TrajectoryScore::poses() const {
  return transformed(pairs_, [](PosePair pair) {
    pair.T_world_body.q.normalize();
    pair.T_map_body.q.normalize();
    return pair;
  });
}

double TrajectoryScore::rotation_rmse(const Quat& q_world_map) const {
  double sum = 0.0;
  const Sequence<PosePair> pairs = poses();
  for (auto next = pairs.read(); const PosePair* pair = next();) {
    const double angle = angle_between(pair->T_world_body.q, q_world_map * pair->T_map_body.q);
    sum += angle * angle;
  }
  return std::sqrt(sum / static_cast<double>(pairs.size())) * 180.0 / std::numbers::pi;
}

std::optional<Pose> TrajectoryScore::first_pose_frame() const {
  if (pairs_.empty() || !orientations_known_) return std::nullopt;
  const auto next = poses().read();
  const PosePair& first = *next();
  return first.T_world_body * first.T_map_body.inverse();
}

AlignedRmse TrajectoryScore::position_rmse_m() const {
  AlignedRmse result;
  if (const auto T_world_map = first_pose_frame()) result.first_pose = rmse(positions(), *T_world_map);
  result.aligned = aligned_rmse(positions());
  return result;
}

AlignedRmse TrajectoryScore::rotation_rmse_deg() const {
  const auto T_world_map = first_pose_frame();
  if (!T_world_map) return {};
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const Sequence<PosePair> pairs = poses();
  for (auto next = pairs.read(); const PosePair* pair = next();)
    sum += (pair->T_world_body.q * pair->T_map_body.q.conjugate()).toRotationMatrix();
  return {rotation_rmse(T_world_map->q), rotation_rmse(nearest_rotation(sum))};
}

Consistency TrajectoryScore::consistency(const std::optional<Pose>& fit) const {
  Consistency consistency;
  if (pairs_.size() < 3 || !orientations_known_ || stated_.empty()) return consistency;
  const Pose T_map_world = fit ? *fit : *rigid_fit([&](const auto& take) {
    const Sequence<PointPair> all = positions();
    for (auto next = all.read(); const PointPair* pair = next();) take(pair->truth, pair->estimate);
  });
  const auto next_pair = poses().read();
  const PosePair* pair = next_pair();
  std::size_t at = 0;
  for (auto next = stated_.read(); const StatedCovariance* stated = next();) {
    for (; at < stated->pair; ++at) pair = next_pair();
    const Eigen::AngleAxisd turn(T_map_world.q * pair->T_world_body.q * pair->T_map_body.q.conjugate());
    Eigen::Matrix<double, 6, 1> error;
    error << T_map_world * pair->T_world_body.t - pair->T_map_body.t, turn.angle() * turn.axis();
    consistency.add(error, stated->covariance);
  }
  return consistency;
}

std::optional<double> TrajectoryScore::position_final_m() const {
  const auto T_world_map = first_pose_frame();
  if (!T_world_map) return std::nullopt;
  PosePair last;
  for (auto next = pairs_.read(); const PosePair* pair = next();) last = *pair;
  return (*T_world_map * last.T_map_body.t - last.T_world_body.t).norm();
}

}  // namespace hallway::eval
