// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/pose_information.hpp"

#include <Eigen/LU>

#include "geometry/symmetric.hpp"

namespace hallway::slam_point {

std::optional<Mat6> PoseInformation::covariance(bool planar) const {
  return is_directional_ ? covariance_by_matrices(planar) : covariance_by_weights(planar);
}

/// With weights alone the position's part of the information is a multiple of the identity, so that the rotation's covariance is the inverse of
/// the points' inertia about their centre, and the rest follows from it.
std::optional<Mat6> PoseInformation::covariance_by_weights(bool planar) const {
  if (!(weight_ > 0.0)) return std::nullopt;
  const Vec3 centre = sum_ / weight_;
  Mat3 inertia = sum_ * centre.transpose() - outer_;
  inertia.diagonal().array() += outer_.trace() - sum_.dot(centre);
  Mat3 turn = Mat3::Zero();
  if (planar) {
    // z, roll and pitch are decoupled from the rest there, and known.
    if (!(inertia(2, 2) > 0.0)) return std::nullopt;
    turn(2, 2) = 1.0 / inertia(2, 2);
  } else {
    const double minor = inertia(0, 0) * inertia(1, 1) - inertia(0, 1) * inertia(0, 1);
    if (!(inertia(0, 0) > 0.0 && minor > 0.0 && inertia.determinant() > 0.0)) return std::nullopt;
    turn = inertia.inverse();
    turn = (0.5 * (turn + turn.transpose())).eval();
  }
  const Mat3 arm = skew(centre);
  const Mat3 travel_turn = arm * turn;
  Mat3 travel = -(travel_turn * arm);
  travel.diagonal().array() += 1.0 / weight_;
  if (planar) travel(2, 2) = 0.0;
  Mat6 covariance;
  covariance << 0.5 * (travel + travel.transpose()), travel_turn, travel_turn.transpose(), turn;
  if (!covariance.allFinite()) return std::nullopt;
  return covariance;
}

std::optional<Mat6> PoseInformation::covariance_by_matrices(bool planar) const {
  // Of x = exp(r) lever + t the derivative by (t, r) is [I, -[lever]x].
  const Mat3 cross = skew(sum_);
  Mat6 information;
  information << weight_ * Mat3::Identity(), -cross, cross, outer_.trace() * Mat3::Identity() - outer_;
  information += directional_;
  if (planar) {
    // z, roll and pitch are decoupled from the rest there, and known.
    information.block<3, 6>(2, 0).setZero();
    information.block<6, 3>(0, 2).setZero();
    information.diagonal().segment<3>(2).setOnes();
  }
  const Inverse<6> inverse = inverse_of_positive<6>(information);
  if (!inverse.is_positive) return std::nullopt;
  Mat6 covariance = inverse.matrix;
  if (planar) covariance.diagonal().segment<3>(2).setZero();
  if (!covariance.allFinite()) return std::nullopt;
  return Mat6(0.5 * (covariance + covariance.transpose()));
}

std::optional<Mat6> pose_covariance(const SubmapGraph& graph, const Observations& frame,
                                    const Pose& T_map_sensor, double noise2_m2) {
  if (noise2_m2 == 0.0) return std::nullopt;
  const PointMotion to_map(T_map_sensor);
  PoseInformation information;
  for (const Observation& observation : frame) {
    if (observation.landmark == kNone) continue;
    const Vec3 lever = to_map.turned(observation.point);
    // This frame's own observation is in the landmark already.
    if (graph.is_directional()) {
      const Mat3 own = ray_information(lever, observation.weights());
      information.add(lever, pair_information(graph.informations[observation.landmark].whole - own, own));
      continue;
    }
    const double others = graph.landmarks[observation.landmark].weight - observation.weight;
    if (others > 0.0) information.add(lever, pair_weight(others, observation.weight));
  }
  std::optional<Mat6> covariance = information.covariance(graph.planar);
  if (covariance) *covariance *= noise2_m2;
  return covariance;
}

}  // namespace hallway::slam_point
