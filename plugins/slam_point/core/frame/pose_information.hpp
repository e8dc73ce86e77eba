// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "slam_point/core/frame/frame.hpp"

namespace hallway::slam_point {

/// Information of points on the pose that they were fitted by to landmarks, for a fit with these weights and observations
/// whose coordinates have the variance 1.
class PoseInformation {
 public:
  /// Adds a point: `lever` leads from the sensor to it, in the map's frame [m]; `weight` as in the fit.
  void add(const Vec3& lever, double weight) {
    const Vec3 weighted = weight * lever;
    weight_ += weight;
    sum_ += weighted;
    add_outer(weighted, lever, outer_);
  }

  /// The same for a pair whose noise has directions: its information, in the map's frame.
  void add(const Vec3& lever, const Mat3& information) {
    is_directional_ = true;
    directional_ += motion_information(lever, information, lever);
  }

  /// Covariance of the pose's error: position (x, y, z), then rotation vector (true = exp(error) * estimate), in the map's
  /// frame. In `planar` data only x, y and the turn about z vary. Empty where the points leave a direction open.
  std::optional<Mat6> covariance(bool planar) const;

 private:
  std::optional<Mat6> covariance_by_weights(bool planar) const;
  std::optional<Mat6> covariance_by_matrices(bool planar) const;

  double weight_ = 0.0;
  Vec3 sum_ = Vec3::Zero();
  Mat3 outer_ = Mat3::Zero();
  bool is_directional_ = false;      // some pairs have matrices
  Mat6 directional_ = Mat6::Zero();  // of these
};

/// Covariance of a placed frame's pose against the map, as Answer::covariance has it, in the map's frame; the frame's observations are in
/// their landmarks already. `noise2_m2`: estimated variance of a coordinate of an observation, 0 while it is not known. Empty then, and
/// where the points leave a direction open. O(points).
std::optional<Mat6> pose_covariance(const SubmapGraph& graph, const Observations& frame,
                                    const Pose& T_map_sensor, double noise2_m2);

}  // namespace hallway::slam_point
