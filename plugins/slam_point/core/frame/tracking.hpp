// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "slam_point/core/frame/motion_prediction.hpp"
#include "slam_point/core/frame/placement.hpp"
#include "slam_point/core/options.hpp"

namespace hallway::slam_point {

/// What the frames so far say of the next one: where the sensor was last, how it moves, and how sure it is that this goes on.
class Tracking {
 public:
  explicit Tracking(const Options& options)
      : prediction_(options.smoothing, options.match_bound()), bridge_frames_(options.bridge_frames) {}

  /// T_submap_sensor expected of the next frame, in the active submap.
  Pose predicted() const {
    return prediction_.after(last_T_submap_sensor_, std::min(frames_without_pose_, bridge_frames_) + 1);
  }
  /// That of the last frame with a pose.
  const Pose& last_T_submap_sensor() const { return last_T_submap_sensor_; }
  /// How many landmarks that frame saw.
  std::size_t last_seen() const { return last_seen_; }
  /// Frames in a row without a pose.
  int frames_without_pose() const { return frames_without_pose_; }
  bool is_long_lost() const { return frames_without_pose_ > kShortGap; }
  /// Whether the frames without a pose are few and none of them shows that the prediction is wrong.
  bool is_bridged() const { return !contradicted_ && !is_long_lost(); }

  /// Learns from a frame that was placed from here: how the sensor moved, or that it has no pose.
  void learn(const Placement& placement) {
    if (placement.has_pose) {
      prediction_.learn(last_T_submap_sensor_.inverse() * placement.T_submap_sensor, frames_without_pose_ + 1,
                        placement.is_searched);
    } else {
      contradicted_ = placement.contradicts_prediction || (frames_without_pose_ > 0 && contradicted_);
      ++frames_without_pose_;
    }
  }
  /// The frame is in the map, where it saw so many landmarks. `T_submap_sensor`: in the submap that is active from now on.
  void enter(const Pose& T_submap_sensor, std::size_t landmarks) {
    last_T_submap_sensor_ = T_submap_sensor;
    last_seen_ = landmarks;
    frames_without_pose_ = 0;
  }

 private:
  static constexpr int kShortGap = 3;  // frames

  MotionPrediction prediction_;
  int bridge_frames_;
  Pose last_T_submap_sensor_;
  std::size_t last_seen_ = 0;
  int frames_without_pose_ = 0;
  bool contradicted_ = false;  // the prediction, by one of the frames without a pose
};

}  // namespace hallway::slam_point
