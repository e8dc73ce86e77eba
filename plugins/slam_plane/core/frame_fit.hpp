// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_plane/core/wall_evidence.hpp"

namespace hallway::slam_plane {

/// What a frame tells of its pose: information of x, y, heading in the frame of the walls, and what of the position it leaves open.
struct PoseInformation {
  Mat3 matrix = Mat3::Zero();
  int open = 2;                   ///< directions of the position that are not determined: 0, 1 or 2
  Vec2 direction = Vec2::Zero();  ///< the open one, or the worst one, unit
  bool heading = false;           ///< that the heading is determined

  bool determined() const { return heading && open == 0; }
  /// Information of the position alone, the heading being free.
  Mat2 position() const;
};

/// Finds the pose of a frame whose observations were given walls: lines always count, ends where both the frame and the wall have
/// a corner. Gauss-Newton steps with weights that do not trust ends far from where they should be.
class FrameFit {
 public:
  explicit FrameFit(const Options& options);

  void clear() { pairs_.clear(); }
  /// An observation and its wall. `wall` must live until the fit is over. Estimates are in the frame that the pose is sought in.
  void add(const AssociatedObservation& observation, const WallEstimate& wall) {
    pairs_.push_back({&observation, &wall, {true, true}});
  }
  /// The same without the ends that are not to count.
  void add(const AssociatedObservation& observation, const WallEstimate& wall, bool end_a, bool end_b) {
    pairs_.push_back({&observation, &wall, {end_a, end_b}});
  }
  std::size_t pairs() const { return pairs_.size(); }

  /// Moves T_frame_robot to the best fit. A direction of the position that the pairs leave open (worse than Options::undetermined_m)
  /// stays as it is given. Returns what the pairs tell.
  PoseInformation solve(Pose2& T_frame_robot) const;

  /// How far from its wall an observation lies at a pose: the square of its distance in standard deviations, of line and angle; two
  /// degrees of freedom.
  double line_distance2(std::size_t pair, const Pose2& T_frame_robot) const;

  /// What a frame's own lines and corners tell of its pose, were all of its walls known.
  PoseInformation own_information(const std::vector<AssociatedObservation>& frame) const;

 private:
  struct Pair {
    const AssociatedObservation* observation;
    const WallEstimate* wall;
    bool end[2];  // that it may count
  };
  /// A residual, its variance, and its derivatives by x, y and heading.
  struct Row {
    double residual;
    double variance;
    Vec3 gradient;
  };
  enum class Ends { doubted, gated };

  void step(Pose2& T, Ends ends, PoseInformation& information) const;
  bool end_row(const Pair& pair, const Pose2& T, Ends ends, Row& row) const;
  void judge(PoseInformation& information) const;

  Noise noise_;
  double undetermined_;
  std::vector<Pair> pairs_;
};

}  // namespace hallway::slam_plane
