// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "eval/consistency.hpp"
#include "eval/metrics.hpp"
#include "eval/point_error.hpp"
#include "eval/pose_pairs.hpp"
#include "eval/sequence.hpp"
#include "geometry/se3.hpp"

namespace hallway::eval {

/// A covariance that is stated for the estimate of a pair of poses.
struct StatedCovariance {
  std::size_t pair = 0;                                                          ///< by index
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< as hw_pose_output_t says
};

/// Compares true and estimated poses, paired by iteration. Each function reads them once or a few times, in memory that does not grow with them.
class TrajectoryScore {
 public:
  TrajectoryScore() = default;
  /// @param orientations_known  of the true poses; false: there are neither rotation errors nor a frame of the first pose
  /// @param stated              by increasing pair
  TrajectoryScore(Sequence<PosePair> pairs, bool orientations_known, Sequence<StatedCovariance> stated = {})
      : pairs_(std::move(pairs)), orientations_known_(orientations_known), stated_(std::move(stated)) {}

  std::size_t pairs() const { return pairs_.size(); }
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
  Sequence<PointPair> positions() const;
  /// With unit quaternions.
  Sequence<PosePair> poses() const;
  double rotation_rmse(const Quat& q_world_map) const;

  Sequence<PosePair> pairs_;
  bool orientations_known_ = true;
  Sequence<StatedCovariance> stated_;
};

}  // namespace hallway::eval
