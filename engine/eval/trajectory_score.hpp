// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "eval/consistency.hpp"
#include "eval/metrics.hpp"
#include "geometry/se3.hpp"

namespace hallway::eval {

/// Compares true and estimated poses, paired by iteration.
class TrajectoryScore {
 public:
  /// Adds an iteration that has both poses.
  /// @param covariance  of the estimate's error, as hw_pose_output_t says, if it is told
  void add(const Pose& T_world_body, const Pose& T_map_body,
           const std::optional<Eigen::Matrix<double, 6, 6>>& covariance = std::nullopt);

  /// Adds an iteration whose true orientation is not known: from then on there are neither rotation errors nor a frame of
  /// the first pose.
  void add_position(const Vec3& true_position, const Pose& T_map_body);

  std::size_t pairs() const { return truth_.size(); }
  /// T_world_map that lets the first estimate coincide with the truth; empty without pairs or without orientations.
  std::optional<Pose> first_pose_frame() const;
  /// Position errors, metres; `aligned` (from three pairs on) is the absolute trajectory error.
  AlignedRmse position_rmse_m() const;
  /// Rotation errors, degrees; `aligned`: after the one rotation of the map that leaves the least sum of squared chordal
  /// distances between true and estimated orientations (Hartley et al. 2013, section 5.3).
  AlignedRmse rotation_rmse_deg() const;
  /// Errors of the poses in the map's frame beside the covariances stated for them. `T_map_world`: how the truth lies in the
  /// map; empty: by the best fit of the poses' positions, which leaves open how a path on a line is turned about it.
  /// Nothing below three pairs or without orientations.
  Consistency consistency(const std::optional<Pose>& T_map_world) const;
  /// Position error of the last pair in first_pose_frame(), metres.
  std::optional<double> position_final_m() const;

 private:
  bool orientations_known_ = true;
  std::vector<Vec3> truth_;
  std::vector<Vec3> estimate_;
  std::vector<Quat> truth_q_;
  std::vector<Quat> estimate_q_;
  struct Stated {
    std::size_t pair = 0;
    Eigen::Matrix<double, 6, 6> covariance;
  };
  std::vector<Stated> stated_;
};

}  // namespace hallway::eval
