// SPDX-License-Identifier: MIT
#pragma once

#include "slam_plane/core/frame_fit.hpp"

namespace hallway::slam_plane {

/// Where a robot is along a direction in which nothing is measured: a Kalman filter of its place and of the step that it takes each frame, of a robot that goes where it
/// looks (thesis 4.3.6, rule 24). Frames that tell the place correct it, each as well as it does: what begins where the last of them are weak does not begin with
/// the error of one of them. The filter gives no evidence; it says where to go on from.
class DeadReckoning {
 public:
  /// A frame's way since the last one: from where keep() left it, half-way turned to the heading `r` (cosine and sine, map frame). `fastest`: longest step so far [m].
  void predict(const Pose2& T_map_submap, const Vec2& r, double fastest);
  /// The place, map frame [m]; defined when is_running().
  Vec2 place() const { return state_.head<2>(); }
  bool is_running() const { return running_; }

  /// What a frame tells of its place. An answer that the filter does not bear (5 sigma) begins it anew.
  void correct(const Pose2& T_map_robot, const PoseInformation& information);
  /// Keeps the place in a submap, with which it moves until the next frame.
  void keep(const Pose2& T_map_submap, const Pose2& T_map_robot);
  /// Nothing is known any more.
  void reset() { running_ = false; }

 private:
  bool running_ = false;
  Vec3 state_ = Vec3::Zero();       // place in the map, and step along the heading [m]
  Mat3 covariance_ = Mat3::Zero();  // of that
  Pose2 kept_;                      // in the submap
};

}  // namespace hallway::slam_plane
