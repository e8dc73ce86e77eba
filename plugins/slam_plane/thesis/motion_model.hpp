// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "slam_plane/thesis/alignment.hpp"
#include "slam_plane/thesis/ring_buffer.hpp"

namespace hallway::slam_plane::thesis {

/// How far the robot goes in an iteration, as the last ones told that measured it: their mean, as far back as it went equally far. Where each tells a place, the noise of all but the
/// first and the last cancels.
class StepLength {
 public:
  static constexpr std::size_t kSteps = 30;

  /// Takes a step that moved the robot by `distance` [m] along an axis to which its way has the cosine `share`, above 0.
  void add(double distance, double share) { steps_.push_back({distance, share}); }

  /// [m]; 0 where nothing was taken.
  double mean() const;

 private:
  struct Step {
    double distance = 0.0;
    double share = 1.0;
  };

  RingBuffer<Step> steps_{kSteps};
};

/// Follows the robot while what it sees leaves the place along a wall open (thesis 4.3.6). The distance from the wall and the heading are measured; the robot is taken to
/// move in the direction in which it looks (Rule 24), so the change of the distance tells how far, and where the wall runs along the movement what was measured before.
class MotionModel {
 public:
  MotionModel(int begin_after, double parallel_deg);

  /// Where the robot may be expected: moved once more as it was last.
  Pose2 predicted() const;
  bool has_pose() const { return has_pose_; }
  const Pose2& pose() const { return pose_; }

  /// Takes a frame that told its position (Rule 26: that ends the model).
  void known(const Pose2& T_map_robot);

  /// Takes a frame that left the place open along `alignment.open`, and @returns it with that place filled in (Rules 24, 25, 27).
  Pose2 restricted(const Alignment& alignment);

  /// Takes a frame that told nothing: the robot goes on as it did, for `kCoast` frames. @returns whether that may still be believed.
  bool coast();
  static constexpr int kCoast = 30;

  /// Takes what a frame told of the pose, if it told anything, and @returns it with what the movement tells; nothing where neither does.
  std::optional<Alignment> completed(std::optional<Alignment> told);

  /// So many frames in a row did not tell a position that the model is on (Rule 26).
  bool active() const { return has_pose_ && unknown_ > begin_after_; }

 private:
  void moved_to(const Pose2& T_map_robot);

  int begin_after_;
  double least_sine_;
  bool has_pose_ = false;
  bool has_step_ = false;
  int unknown_ = 0;
  int coasted_ = 0;
  Pose2 pose_;
  Pose2 step_;        // the last movement, in the robot's frame before it
  StepLength steps_;  // those that were measured
};

}  // namespace hallway::slam_plane::thesis
