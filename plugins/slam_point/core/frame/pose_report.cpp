// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/pose_report.hpp"

#include "slam_point/core/fit/robust_fit.hpp"
#include "slam_point/core/frame/pose_information.hpp"

namespace hallway::slam_point {

std::optional<Mat6> pose_covariance(const SubmapGraph& graph, const std::vector<Observation>& frame,
                                    const Pose& T_map_sensor, double noise2_m2, bool planar) {
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
  std::optional<Mat6> covariance = information.covariance(planar);
  if (covariance) *covariance *= noise2_m2;
  return covariance;
}

Mat6 told_from(const Pose& anchor, const Mat6& covariance) {
  const Mat3 turn = anchor.q.toRotationMatrix();
  Mat6 told;
  for (Eigen::Index row = 0; row < 6; row += 3) {
    for (Eigen::Index column = 0; column < 6; column += 3) {
      const Mat3 half = turn.transpose() * covariance.block<3, 3>(row, column);
      told.block<3, 3>(row, column) = half * turn;
    }
  }
  return told;
}

}  // namespace hallway::slam_point
